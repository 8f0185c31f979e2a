"""The hall looks the same after half a turn where it should, and the driver gets to its ends."""

import math

import numpy as np
import pytest

from grader.companions.map_messages import pose_2d
from grader.exercises.localization.kidnapped.hall import (
    ALIKE,
    HALF_LENGTH,
    carried_hall,
    hall,
    trip,
    twin,
)
from grader.exercises.localization.kidnapped.hall_driver import wandering
from grader.geometry import Pose2D
from grader.geometry.ground import RESOLUTION, ground
from sim import run
from sim.world.lidar import Lidar

SEEDS = range(20)


def _differences(seed, places):
    """By how much each ray differs between a pose and its twin, at these distances from the middle."""
    world, middle = hall(seed), trip(seed).middle
    lidar, most = Lidar(world.lidar, world.segments(), world.discs()), world.lidar.range_max
    draw = np.random.default_rng(seed)
    for x in places:
        pose = Pose2D(middle[0] + x, middle[1] + draw.uniform(-0.3, 0.3), draw.uniform(-3, 3))
        here, there = (lidar.distances(*one).clip(max=most) for one in (pose, twin(pose, middle)))
        yield np.abs(here - there)


@pytest.mark.parametrize("seed", SEEDS)
def test_no_scan_tells_twins_apart_in_the_middle(seed):
    for difference in _differences(seed, np.linspace(-ALIKE, ALIKE, 13)):
        assert difference.max() < 1e-6


@pytest.mark.parametrize("seed", range(200))
def test_more_than_8_percent_of_the_rays_tell_the_ends_apart(seed):
    for difference in _differences(seed, (-4.4, -3.7, 3.7, 4.4)):
        assert (difference > 0.1).mean() > 0.08


@pytest.mark.parametrize("seed", SEEDS)
def test_the_map_looks_the_same_after_half_a_turn_except_near_the_ends(seed):
    occupied = ground(hall(seed)).occupied
    differs = np.nonzero((occupied != occupied[::-1, ::-1]).any(axis=0))[0]
    far = np.abs((differs + 0.5) - occupied.shape[1] / 2) * RESOLUTION
    assert differs.size  # otherwise no robot could ever tell
    assert far.min() > ALIKE + hall(seed).lidar.range_max - RESOLUTION
    assert far.max() < HALF_LENGTH


def test_the_twin_of_a_twin_is_the_pose():
    pose, middle = Pose2D(1.0, -2.0, 2.5), (0.5, 3.0)
    assert twin(pose, middle).is_near(Pose2D(0.0, 8.0, 2.5 - math.pi), 1e-9, 1e-9)
    assert twin(twin(pose, middle), middle).is_near(pose, 1e-9, 1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_robot_starts_and_is_put_down_where_it_cannot_know(seed):
    one, floor = trip(seed), ground(hall(seed))
    for x, y, _ in (one.start, one.put_down):
        assert abs(x - one.middle[0]) < ALIKE
        column, row = floor.cell((x, y))
        assert floor.clearance[row, column] > hall(seed).robot.radius + 0.1


@pytest.mark.parametrize("seed", [3, 8])
def test_the_driver_reaches_an_end_before_and_after_the_robot_is_carried(seed):
    recording = run(companions=wandering(seed), world=carried_hall(seed), seconds=44, seed=seed, quiet=True)
    middle = trip(seed).middle[0]
    ends = [pose.stamp for pose in recording.path if abs(pose.x - middle) > 4.4]
    carried = trip(seed).carried
    assert recording.contacts == []
    assert min(ends) < carried - 2.5
    assert min(stamp for stamp in ends if stamp > carried + 1) < carried + 17
    assert recording.pose_at(carried + 0.1).x == pytest.approx(trip(seed).put_down[0], abs=0.1)


def test_the_robot_is_parked_at_one_of_two_twins_in_an_order_that_does_not_tell_which():
    firsts = set()
    for seed in (1, 2, 3, 4):
        one = trip(seed)
        recording = run(companions=wandering(seed), seconds=0.2, quiet=True)
        poses = recording.messages("/parking_poses")[0].message.poses
        places = [Pose2D(*pose_2d(pose)) for pose in poses]
        near = [place.is_near(Pose2D(*one.start), 0.1, 0.1) for place in places]
        assert sorted(near) == [False, True]
        assert twin(places[0], one.middle).is_near(places[1], 1e-6, 1e-6)
        firsts.add(near[0])
    assert firsts == {False, True}
