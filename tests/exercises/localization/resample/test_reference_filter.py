"""The reference filter against closed forms: if it were wrong, right answers would lose points."""

import math

import numpy as np
import pytest

from grader.exercises.localization.resample.reference_filter import (
    ALONG,
    ASIDE,
    BEND,
    COUNT,
    TURN,
    ReferenceFilter,
    shape_of,
)
from grader.exercises.localization.resample.tour import RANGE_SPREAD
from grader.geometry import Pose2D

ORIGIN = Pose2D(7.0, -3.0, 1.0)  # of the odometry; it has nothing to do with the map


def begun(pose, deviations=(0.0, 0.0, 0.0)):
    covariance = np.zeros((6, 6))
    for index, deviation in zip((0, 1, 5), deviations, strict=True):
        covariance[index, index] = deviation**2
    reference = ReferenceFilter(1)
    reference.move(ORIGIN)
    reference.start(pose, covariance.ravel())
    return reference


def ahead(reference, meters, steps=20):
    for step in range(1, steps + 1):
        far = meters * step / steps
        reference.move(Pose2D(*ORIGIN.point((far, 0.0)), ORIGIN.yaw))


@pytest.mark.parametrize("yaw", [0.0, math.pi / 2, -2.0, math.pi])
def test_a_drive_spreads_the_particles_along_and_across_the_robot(yaw):
    reference = begun((1.0, 2.0, yaw))
    ahead(reference, 1.0)
    shape = reference.shape
    assert shape.mean[:2] == pytest.approx((1.0 + math.cos(yaw), 2.0 + math.sin(yaw)), abs=0.01)
    assert math.remainder(shape.mean[2] - yaw, math.tau) == pytest.approx(0.0, abs=0.01)
    # The heading's error grows along the way, and takes the rest of the way aside.
    assert shape[1:] == pytest.approx(
        (math.sqrt(ALONG), math.sqrt(ASIDE + BEND / 3), math.sqrt(BEND)), rel=0.06
    )


def test_the_noise_does_not_depend_on_the_number_of_steps():
    few, many = begun((0.0, 0.0, 0.5)), begun((0.0, 0.0, 0.5))
    ahead(few, 1.0, 5)
    ahead(many, 1.0, 100)
    assert few.shape[1:] == pytest.approx(many.shape[1:], rel=0.08)


def test_a_turn_spreads_the_heading_alone():
    reference = begun((1.0, 2.0, 3.0))
    for step in range(1, 11):
        reference.move(Pose2D(*ORIGIN[:2], math.remainder(ORIGIN.yaw + 0.2 * step, math.tau)))
    shape = reference.shape
    assert shape.mean == pytest.approx((1.0, 2.0, math.remainder(5.0, math.tau)), abs=0.01)
    assert shape[1:] == pytest.approx((0.0, 0.0, math.sqrt(TURN * 2.0)), rel=0.05)


def test_the_start_has_the_spread_of_its_covariance():
    assert begun((0.0, 0.0, 0.0), (0.3, 0.2, 0.1)).shape[1:] == pytest.approx((0.3, 0.2, 0.1), rel=0.05)


def test_a_range_narrows_the_cloud_towards_the_beacon_as_bayes_says():
    reference = begun((0.0, 0.0, 0.0), (0.2, 0.2, 0.1))
    reference.weigh((100.0, 0.0), 99.9)
    along = math.sqrt(1 / (1 / 0.2**2 + 1 / RANGE_SPREAD**2))
    weight = 0.2**2 / (0.2**2 + RANGE_SPREAD**2)
    shape = reference.shape
    assert shape.mean[0] == pytest.approx(0.1 * weight, abs=0.01)
    assert shape[1:] == pytest.approx((along, 0.2, 0.1), rel=0.06)


def test_a_second_range_counts_after_a_decimeter_only():
    reference = begun((0.0, 0.0, 0.0), (0.2, 0.2, 0.0))
    reference.weigh((100.0, 0.0), 100.0)
    before = reference.shape
    ahead(reference, 0.05)
    reference.weigh((100.0, 0.0), 99.95)
    assert reference.shape.along == pytest.approx(math.hypot(before.along, math.sqrt(0.05 * ALONG)), rel=0.03)
    ahead(reference, 0.11)
    reference.weigh((100.0, 0.0), 99.89)
    assert reference.shape.along < 0.85 * before.along


def test_it_resamples_when_fewer_than_half_count():
    reference = begun((0.0, 0.0, 0.0), (0.1, 0.1, 0.0))
    reference.weigh((100.0, 0.0), 100.0)
    assert np.ptp(reference.logs) > 0
    assert len(np.unique(reference.poses, axis=0)) == COUNT
    wide = begun((0.0, 0.0, 0.0), (1.0, 0.1, 0.0))
    wide.weigh((100.0, 0.0), 100.0)
    assert np.ptp(wide.logs) == 0
    assert len(np.unique(wide.poses, axis=0)) < COUNT / 2
    assert wide.shape.along == pytest.approx(RANGE_SPREAD, rel=0.06)


def test_the_mean_of_headings_around_pi_is_there():
    poses = np.array([(0.0, 0.0, math.pi - 0.1), (0.0, 0.0, 0.1 - math.pi)])
    shape = shape_of(poses, np.array([0.5, 0.5]))
    assert abs(shape.mean[2]) == pytest.approx(math.pi)
    assert shape.yaw == pytest.approx(0.1)


def test_weights_count_in_the_shape():
    poses = np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)])
    shape = shape_of(poses, np.array([0.8, 0.2]))
    assert shape.mean[0] == pytest.approx(0.2)
    assert shape.along == pytest.approx(0.4)
