"""Nodes in another process get the same score pages as in one process.

A right one and a wrong one of short exercises every day, and of the others at night: most of their model
answers are marked so each day by tests/marking/test_solutions.py. `python -m tests.exercises.remote`
compares all.
"""

import pytest

from tests.exercises.assignment import is_long
from tests.exercises.remote import earned, exercises, judge, right, wrong
from tests.exercises.score_tables import page
from tests.sim.ros.remote.follower_process import FollowerProcess


@pytest.fixture(scope="module")
def follower():
    process = FollowerProcess()
    yield process
    process.close()


def rows(pairs):
    return [pytest.param(*pair, marks=[pytest.mark.soak] if is_long(judge(*pair)) else []) for pair in pairs]


@pytest.mark.parametrize(("assignment", "exercise"), rows(exercises()))
def test_a_right_node_earns_everything_with_private_seeds(follower, assignment, exercise):
    name = right(assignment, exercise)[0]
    most = judge(assignment, exercise).points
    assert earned(follower, assignment, exercise, name, "a secret of this test") == f"{name}: {most:g}"


@pytest.mark.parametrize(
    ("assignment", "exercise"),
    rows(pair for pair in exercises() if pair[0] not in ("sensing", "guarding", "navigator", "navigating")),
)
def test_a_wrong_node_gets_the_text_of_its_page(follower, assignment, exercise):
    names = wrong(assignment, exercise)
    name = names[len(names) // 2]
    assert earned(follower, assignment, exercise, name) == page(assignment, exercise)[name]
