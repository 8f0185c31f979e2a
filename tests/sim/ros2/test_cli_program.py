"""ros2 commands as programs of a run."""

import pytest

from sim import run
from sim.ros2.cli_program import terminal

TWIST = "geometry_msgs/msg/Twist '{linear: {x: 0.3}}'"
OUTPUT = {
    "ros topic list": "ros: command not found\n",
    "ros2 topic pub '": "\"ros2 topic pub '\" can't be read: No closing quotation.\n",
    "ros2 topic pub /cmd_vel Twist": "The passed message type is invalid\n",
    "ros2 topic pub '/a b' std_msgs/msg/Empty": "Invalid topic name: topic name must not contain characters",
    "ros2 topic list": "/bumper\n/clock\n/cmd_vel\n",
    "ros2 topic hz /odom": "average rate: 20.000\n",
}


def typed(command):
    return run(terminal(command), world="yard", seconds=2, quiet=True)


def test_a_command_takes_part_in_a_run():
    recording = typed(f"ros2 topic pub -r 10 /cmd_vel {TWIST}")
    received = recording.messages("/cmd_vel")
    assert {one.sender for one in received} == {"/_ros2cli"}
    assert [one.stamp for one in received[:3]] == [0.0, 0.1, 0.2]
    assert recording.path[-1].x > 0.4


@pytest.mark.parametrize("command", OUTPUT)
def test_its_output_is_printed(command):
    text = "".join(text for _, text in typed(command).prints)
    assert text.startswith(OUTPUT[command])


def test_a_function_returns_the_command_when_the_program_starts():
    assert typed(lambda: "ros2 node list").prints[0][1] == "/robot"


def test_an_invalid_command_is_reported():
    says = "None is not a command: expected a text such as 'ros2 topic list'."
    assert typed(lambda: None).prints[0][1] == says
