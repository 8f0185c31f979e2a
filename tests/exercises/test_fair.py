"""How seeds are found in which good robots do their work."""

import pytest

from grader import Exercise, Missed, Scenario
from tests.exercises.fair import is_fair
from tests.exercises.reference import solution
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


@talk.check(1, only="late")
def sends_in_order(run):
    """It sends in the usual order."""
    if run.seed == 8 and run.order:
        raise Missed("the usual order", run.order)


def test_a_seed_is_fair_where_nothing_is_missed_in_any_order():
    early, late = talk.scenarios

    def is_fair_for(scenario, program, seed):
        return is_fair(talk, scenario, (program,), seed, orders=2)

    assert [is_fair_for(early, misfits.Talker, seed) for seed in (6, 7, 8)] == [True, True, True]
    assert [is_fair_for(late, misfits.Talker, seed) for seed in (6, 7, 8)] == [True, False, False]
    assert not is_fair_for(early, misfits.SilentTalker, 6)


def test_the_solutions_robot_is_what_its_notebook_lists():
    programs = solution("delivery", "deliver")
    assert [program.__name__ for program in programs] == ["Perception", "Decision", "Control"]
    with pytest.raises(ValueError, match=r"13b_delivery/delivery.ipynb grades no dance$"):
        solution("delivery", "dance")
