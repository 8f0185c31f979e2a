"""Angles made by `numpy.arange` are one fewer than the rays of a scan, whatever the error that follows."""

import pytest

from grader.diagnosis import find_fault
from sim import run
from tests.students import sensor_mistakes as mistakes

ADVICE = (
    "The scan has 360 ranges, but np.arange(angle_min, angle_max, angle_increment) gives 359 angles: it leaves out its "
    "end. Count the rays instead: `angles = msg.angle_min + np.arange(len(msg.ranges)) * msg.angle_increment`."
)
WRONG = mistakes.OneAngleShort, mistakes.AngleOfEachRay, mistakes.AnglesOfNearRays, mistakes.AnglesInAList


def fault(node):
    return find_fault(run(node, world="room", seconds=0.2, quiet=True))


@pytest.mark.parametrize("node", WRONG, ids=lambda node: node.__name__)
def test_the_missing_angle_is_named(node):
    assert fault(node).hint == ADVICE


def test_another_index_keeps_its_advice_and_angles_of_all_rays_are_right():
    assert fault(mistakes.OneAngleShortAndAnotherIndex).hint == (
        "The list has no item with that number: the first is number 0, the last is len(...) - 1."
    )
    assert fault(mistakes.ReadsAngles) is None
