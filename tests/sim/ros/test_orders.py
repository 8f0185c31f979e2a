"""Tests that a run can happen in other orders, and that what is right in all of them is never reported."""

import pytest

from sim import explore, run
from tests.sim.ros.racy_programs import PROGRAMS, Racy

MOST_DEPARTURES = 3


def no_errors(recording) -> bool:
    return not recording.errors


@pytest.mark.parametrize("racy", PROGRAMS.values(), ids=PROGRAMS)
def test_a_racy_program_is_found_and_shrunk(racy: Racy):
    found = explore(*racy.wrong, holds=no_errors, level=racy.level, seconds=racy.seconds)
    assert found.failed
    assert 0 < len(found.departures) <= MOST_DEPARTURES
    again = run(*racy.wrong, seconds=racy.seconds, quiet=True, order=found.failed)
    assert again.digest == found.recording.digest
    assert again.errors


@pytest.mark.parametrize("racy", PROGRAMS.values(), ids=PROGRAMS)
def test_its_right_twin_is_not_reported(racy: Racy):
    found = explore(*racy.right, holds=no_errors, level=racy.level, orders=20, seconds=racy.seconds)
    assert found.failed is None, found.explanation
    assert found.tried == 20


@pytest.mark.soak
@pytest.mark.parametrize("racy", PROGRAMS.values(), ids=PROGRAMS)
def test_its_right_twin_is_not_reported_in_a_thousand_orders(racy: Racy):
    found = explore(*racy.right, holds=no_errors, level=racy.level, orders=1_000, seconds=racy.seconds)
    assert found.failed is None, found.explanation


class Evasive:
    """An object that answers no question."""

    def __getattribute__(self, name):
        raise RuntimeError(f"no {name}")


EVASIVE = Evasive()


class HasEvasiveParts(PROGRAMS["pairing"].wrong[1]):
    """A right node beside such an object, and with one in it."""

    part = Evasive()


def test_objects_that_answer_no_question_do_not_stop_another_order():
    recording = run(HasEvasiveParts, seconds=1, quiet=True, order=1)
    assert recording.errors == []
    assert len(recording.messages("/a")) >= 4
