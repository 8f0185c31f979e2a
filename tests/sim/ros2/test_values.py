"""Values in a command: the usual mistakes with YAML, and what they say."""

import pytest

from sim.ros2.notebook import ros2
from sim.ros2.system import CliError
from sim.ros2.text import read_values


@pytest.mark.parametrize("values, rest", [("{linear: {x: 0.5}}", "{x: 0.5}}"), ("data: Hello", "Hello")])
def test_values_without_quotes(capsys, values, rest):
    ros2(f"topic pub --once /cmd_vel geometry_msgs/msg/Twist {values}")
    assert capsys.readouterr().out.splitlines()[-2:] == [
        f"ros2: error: unrecognized arguments: {rest}",
        'A value with spaces needs quotes around it: "{linear: {x: 0.5}}".',
    ]


def test_an_unknown_option_is_no_value(capsys):
    ros2("topic list --nothing")
    assert capsys.readouterr().out.splitlines()[-1] == "ros2: error: unrecognized arguments: --nothing"


@pytest.mark.parametrize("text", ["{linear:{x:0.5}}", "{linear: {x:0.5}}", "[{x:0.5}]"])
def test_a_colon_without_a_space(text):
    with pytest.raises(CliError) as caught:
        read_values(text)
    assert str(caught.value) == (
        f"{text!r} is not what it looks like: YAML needs a space after each colon. Write x: 0.5, not x:0.5."
    )


def test_a_missing_brace():
    with pytest.raises(CliError) as caught:
        read_values("{linear: {x: 0.5}")
    last = str(caught.value).splitlines()[-1]
    assert last == 'Each { needs its }, and the whole value is in quotes: "{linear: {x: 0.5}}".'


def test_right_values():
    assert read_values("{linear: {x: 0.5}, text: 'a:b', empty: }") == {
        "linear": {"x": 0.5},
        "text": "a:b",
        "empty": None,
    }
