"""How seeds are found in which good robots do their work."""

import pytest

from grader import Exercise, Missed, Scenario
from tests.exercises.fair import solution, unfair
from tests.students import misfits

talk = Exercise(
    "talk", "A talker", scenarios=[Scenario(seconds=3, name="early"), Scenario(seconds=3, name="late")]
)


@talk.check(1)
def sends(run):
    """It sends."""
    if not run.messages("/chatter"):
        raise Missed("messages", "none")


@talk.check(1, only="late")
def sends_at_last(run):
    """It sends at last."""
    if run.seed == 7:
        raise Missed("a fair seed", "7")


def test_a_seed_is_unfair_for_each_scenario_in_which_something_is_missed():
    assert unfair(talk, (misfits.Talker,), 6) == set()
    assert unfair(talk, (misfits.Talker,), 7) == {"late"}
    assert unfair(talk, (misfits.SilentTalker,), 6) == {"early", "late"}


def test_the_solutions_robot_is_what_its_notebook_lists():
    programs = solution("13_delivery", "deliver")
    assert [program.__name__ for program in programs] == ["Perception", "Decision", "Control"]
    with pytest.raises(ValueError, match=r"13_delivery/delivery.ipynb grades no dance$"):
        solution("13_delivery", "dance")
