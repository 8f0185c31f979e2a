"""Nodes that live in another process get the points and the words that they get in one.

A few of each exercise; `python -m tests.sim.ros.remote.tables` compares all.
"""

import pytest

from tests.exercises.score_tables import page
from tests.sim.ros.remote.tables import earned, exercises, judge, right, wrong

SLOW = ("sensing", "navigator")
QUICK = [pair for pair in exercises() if pair[0] not in SLOW]
ALL = [*QUICK, *(pytest.param(*pair, marks=pytest.mark.soak) for pair in exercises() if pair[0] in SLOW)]


@pytest.mark.parametrize(("assignment", "exercise"), ALL)
def test_a_right_node_earns_everything_with_private_seeds(apart, assignment, exercise):
    name = right(assignment, exercise)[0]
    most = judge(assignment, exercise).points
    assert earned(apart, assignment, exercise, name, "a secret of this test") == f"{name}: {most:g}"


@pytest.mark.parametrize(("assignment", "exercise"), QUICK)
def test_a_wrong_node_gets_the_words_of_its_table(apart, assignment, exercise):
    names = wrong(assignment, exercise)
    name = names[len(names) // 2]
    assert earned(apart, assignment, exercise, name) == page(assignment, exercise)[name]
