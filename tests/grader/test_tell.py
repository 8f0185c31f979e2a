import pytest

from grader import tell
from sim import Recording, run
from sim.evidence import CallbackError, Ended
from tests.sim.ros.test_launch_lifecycle import BY_EVENTS, launch_file  # noqa: F401
from tests.sim.ros.test_parameter_sources import FILES, given_three_times
from tests.sim.ros.test_turtle_launch import simulators
from tests.students import misfits


def ended(reason, detail, *errors):
    return Recording(seconds=3.0, errors=list(errors), ended=Ended(reason, 3.0, detail))


def raised(type, text):
    trace = '  File "<cell>", line 7, in tick\n'
    return ended("error", "", CallbackError(1.0, "/talker", "Talker.tick", type, text, trace))


def test_a_run_without_an_error(capsys):
    tell(ended("time", "All 3 s were run."))
    assert capsys.readouterr().out == "No error. All 3 s were run.\n"


def test_an_exercise_that_is_not_started(capsys):
    tell(raised("NotImplementedError", ""))
    assert capsys.readouterr().out == (
        "Not started yet: write your code where it says YOUR CODE HERE, delete the line that raises\n"
        "NotImplementedError, and run both cells again.\n"
    )


def test_an_error_comes_with_its_place_and_a_hint(capsys):
    tell(raised("NameError", "name 'String' is not defined"))
    assert capsys.readouterr().out == (
        "NameError: name 'String' is not defined (in Talker.tick, line 7, at 1 s)\n"
        "Hint: `String` is not imported: write `from std_msgs.msg import String` at the top.\n"
    )


def test_a_run_that_hangs(capsys):
    tell(ended("hang", "Talker.tick never returned."))
    assert capsys.readouterr().out == (
        "Talker.tick never returned.\n"
        "Hint: Look there for a loop that never ends (`while True:` without a way out), or a wait for\n"
        "something that never happens. A callback should do one small step and return.\n"
    )


def test_a_run_without_an_error_in_which_something_is_wrong(capsys):
    tell(run(misfits.BestEffortTalker, misfits.Listener, seconds=3, quiet=True))
    assert capsys.readouterr().out == (
        "On /chatter the QoS settings are incompatible: /talker publishes with reliability best_effort,\n"
        "/listener requests reliable, so nothing arrives. An offer has to be at least as strong as the\n"
        "request: offer reliable, or request best_effort.\n"
    )


def test_transitions_that_a_launch_file_requests_are_no_error(launch_file, capsys):  # noqa: F811
    tell(run(launch_file(BY_EVENTS), seconds=5, quiet=True))
    assert capsys.readouterr().out.splitlines()[0].startswith("No error.")


@pytest.mark.parametrize("name", FILES)
def test_several_start_values_of_a_parameter_are_no_error(name, tmp_path, capsys):
    tell(run(given_three_times(tmp_path, name), seconds=1, quiet=True))
    assert capsys.readouterr().out == "No error. All 1 s were run.\n"


@pytest.mark.parametrize("count", [1, 2])
def test_turtlesims_beside_the_world_s_own_are_no_error(count, tmp_path, capsys):
    tell(run(simulators(tmp_path, count), world="turtlesim", seconds=3, quiet=True))
    assert capsys.readouterr().out == "No error. All 3 s were run.\n"
