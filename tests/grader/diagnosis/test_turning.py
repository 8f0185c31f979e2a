"""A turn on the spot that its node never finds done is named, and no other one."""

import re

import pytest

from grader.diagnosis import find_flaw
from sim import run
from tests.students import turns


@pytest.mark.parametrize("node", turns.ENDLESS, ids=lambda node: node.__name__)
def test_a_turn_that_is_never_done_is_named(node):
    sentence = find_flaw(run(node, world="room", seconds=30, quiet=True))
    assert re.sub(r"since \S+ s, by \S+ full", "since S s, by N full", sentence) == (
        "/turner has turned the robot on the spot since S s, by N full turns, and never found the turn done. "
        "Compare the normalized difference with a tolerance, `abs(math.remainder(target - yaw, math.tau)) < "
        "0.05`, because a heading, in radians, jumps from pi to -pi; and calculate the target once, before the turn."
    )


@pytest.mark.parametrize("node", turns.RIGHT, ids=lambda node: node.__name__)
def test_a_turn_without_end_may_be_right(node):
    assert find_flaw(run(node, world="room", seconds=30, quiet=True)) == ""
