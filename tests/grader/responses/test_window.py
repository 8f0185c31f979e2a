"""Both edges of a window belong to it, and nothing outside does."""

import pytest

from grader.responses import EDGE, Window
from sim.evidence import Ended, Pose, Recording


@pytest.mark.parametrize(
    ("stamp", "inside"),
    [
        (1.0, True),
        (1.5, True),
        (1.0 - EDGE / 2, True),
        (1.5 + EDGE / 2, True),
        (1.0 - 2 * EDGE, False),
        (1.5 + 2 * EDGE, False),
    ],
)
def test_both_edges_are_inside(stamp, inside):
    assert Window.after(1.0, 0.5).contains(stamp) is inside


def test_rows_inside_keep_their_order():
    path = [Pose(stamp, 0.0, 0.0, 0.0) for stamp in (0.9, 1.5, 1.0, 1.6)]
    assert [pose.stamp for pose in Window(1.0, 1.5).rows(path)] == [1.5, 1.0]


def test_the_part_before_a_stamp_does_not_contain_it():
    window = Window(1.0, 1.5)
    assert not window.before(1.2).contains(1.2)
    assert window.before(1.2).contains(1.2 - 3 * EDGE)
    assert window.before(1.7) == window


@pytest.mark.parametrize(("end", "over"), [(1.5, False), (1.5 + EDGE / 2, False), (1.5 + 2 * EDGE, True)])
def test_a_window_is_over_in_a_run_that_lasts_longer(end, over):
    assert Window(1.0, 1.5).is_over(Recording(ended=Ended("time", end, ""))) is over
