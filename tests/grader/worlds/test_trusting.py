"""A robot that trusts its last command drives on in silence, and what the checks say of it."""

import pytest

from grader.checks import Missed, ends_with_a_stop
from grader.diagnosis.driving import still_obeyed
from grader.responses import Window, require_standing
from grader.worlds.rooms import long_hall
from grader.worlds.trusting import trusting
from sim import World, run
from tests.students import flaws

OBEYS = (
    "The robot still obeys its last command, 0.2 m/s and 0 rad/s on /cmd_vel at 1.9 s: silence is not a stop. "
    "Send zeros."
)


@pytest.fixture(scope="module")
def runs():
    """A driver that falls silent after 2 s: with the usual robot, and with one that trusts it."""
    worlds = "yard", trusting("yard")(1)
    return [run(flaws.FallsSilent, world=world, seconds=5, quiet=True) for world in worlds]


def test_a_trusting_robot_drives_on_in_silence(runs):
    usual, trustful = (recording.path[-1].x for recording in runs)
    assert usual < 0.55 < 0.85 < trustful


def test_it_is_the_same_world_otherwise():
    for given, made in ((long_hall, trusting(long_hall)(7)), (long_hall(7), trusting(long_hall(7))(7))):
        world = given(7) if callable(given) else given
        assert made.robot.command_timeout == 1000.0 != world.robot.command_timeout
        assert (made.name, made.bounds, made.start) == (world.name, world.bounds, world.start)
    assert World.load("yard").robot.command_timeout == 0.5


def test_a_last_command_that_moves_has_advice_for_this_robot(runs):
    with pytest.raises(Missed) as missed:
        ends_with_a_stop(runs[1])
    assert missed.value.saw == "the last command on /cmd_vel, at 1.9 s, was 0.2 m/s and 0 rad/s"
    assert missed.value.hint == (
        "This robot obeys its last command until the next one arrives: silence doesn't stop it. Publish a Twist() "
        "with all zeros at the end."
    )


def test_what_the_robot_still_obeys_is_named_once_the_program_is_silent(runs):
    for recording in runs:
        assert still_obeyed(recording, 2.3) == ""
        assert still_obeyed(recording, 2.5) == OBEYS
    with pytest.raises(Missed) as missed:
        require_standing(runs[1], Window(3.0, 4.0), "1 s after the driver's last command", "Look at its age.")
    assert missed.value.hint == OBEYS


def test_a_robot_that_is_sent_zeros_obeys_those():
    recording = run(flaws.Driver, flaws.FallsSilent, world="yard", seconds=1, quiet=True)
    assert still_obeyed(recording, 1.0) == ""
