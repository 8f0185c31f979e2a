"""Nodes that live in another process get the points and the words that they get in one.

Two of each exercise, every day of short ones only; `python -m tests.sim.ros.remote.tables` compares all.
"""

import pytest

from tests.exercises.assignment import is_long
from tests.exercises.score_tables import page
from tests.sim.ros.remote.tables import earned, exercises, judge, right, wrong


def rows(pairs):
    return [pytest.param(*pair, marks=[pytest.mark.soak] if is_long(judge(*pair)) else []) for pair in pairs]


@pytest.mark.parametrize(("assignment", "exercise"), rows(exercises()))
def test_a_right_node_earns_everything_with_private_seeds(apart, assignment, exercise):
    name = right(assignment, exercise)[0]
    most = judge(assignment, exercise).points
    assert earned(apart, assignment, exercise, name, "a secret of this test") == f"{name}: {most:g}"


@pytest.mark.parametrize(
    ("assignment", "exercise"),
    rows(pair for pair in exercises() if pair[0] not in ("sensing", "navigator")),
)
def test_a_wrong_node_gets_the_words_of_its_table(apart, assignment, exercise):
    names = wrong(assignment, exercise)
    name = names[len(names) // 2]
    assert earned(apart, assignment, exercise, name) == page(assignment, exercise)[name]
