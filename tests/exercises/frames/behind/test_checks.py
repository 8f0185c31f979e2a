"""The gap to the leader in a run that ends before the robot should have caught up."""

import pytest

from grader.checks import Missed
from grader.exercises.frames.behind import keeps_the_gap
from sim import Recording
from sim.evidence import Pose


def test_a_run_that_ends_early_keeps_no_gap():
    path, leader = [Pose(8.0, 0.0, 0.0, 0.0)], [Pose(8.0, 1.0, 0.0, 0.0)]
    with pytest.raises(Missed) as missed:
        keeps_the_gap(Recording(path=path, tracks={"leader": leader}))
    assert (missed.value.expected, missed.value.saw, missed.value.hint) == (
        "a robot that follows until 9 s and longer",
        "the run ended earlier",
        "",
    )
