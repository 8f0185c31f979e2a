"""A lidar may differ from what the robot reports of it: its pose, its clock, and when its transform comes."""

import math
from dataclasses import replace

import numpy as np
import pytest

from sim import World, run, since_start
from sim.world.lidar import NEVER

ROOM = World.load("room")


def recorded(seconds=1.0, **faults):
    """A run of a robot without a program, whose lidar has these faults and no noise."""
    lidar = replace(ROOM.lidar, noise=0.0, **faults)
    return run(world=replace(ROOM, lidar=lidar), seconds=seconds, quiet=True)


def ranges_of(recording):
    return np.array(recording.messages("/scan")[-1].message.ranges)


def test_a_lidar_askew_is_turned_further_than_its_transform_says():
    step = ROOM.lidar.angle_increment
    askew, right = recorded(yaw_error=10 * step), recorded()
    assert ranges_of(askew) == pytest.approx(np.roll(ranges_of(right), -10), abs=1e-4)
    transforms = [run.messages("/tf_static")[0].message for run in (askew, right)]
    assert transforms[0] == transforms[1]


def test_a_lidar_off_center_measures_from_there_and_its_transform_says_the_center():
    aside = recorded(x_error=0.03, y_error=-0.05)
    assert ranges_of(aside) == pytest.approx(ranges_of(recorded(x=0.03, y=-0.05)), abs=1e-6)
    place = aside.messages("/tf_static")[0].message.transforms[0].transform.translation
    assert (place.x, place.y) == (0.0, 0.0)


def test_errors_add_to_a_mounting_that_is_reported():
    both = recorded(x=0.02, yaw=math.pi / 2, x_error=0.03, yaw_error=0.1)
    assert ranges_of(both) == pytest.approx(ranges_of(recorded(x=0.05, yaw=math.pi / 2 + 0.1)), abs=1e-5)


@pytest.mark.parametrize("offset", [0.25, -0.25])
def test_a_clock_that_is_off_stamps_scans_and_nothing_else(offset):
    recording = recorded(clock_offset=offset)
    stamps = {
        topic: [since_start(row.message.header.stamp) - row.stamp for row in recording.messages(topic)]
        for topic in ("/scan", "/odom")
    }
    assert stamps["/scan"] == pytest.approx([offset] * 21)
    assert stamps["/odom"] == pytest.approx([0.0] * 21)


@pytest.mark.parametrize(("delay", "moments"), [(0.0, [0.0]), (0.5, [0.5]), (NEVER, [])])
def test_a_lidar_s_transform_may_come_late_or_never(delay, moments):
    rows = recorded(transform_delay=delay).messages("/tf_static")
    assert [row.stamp for row in rows] == pytest.approx(moments)
    assert [since_start(row.message.transforms[0].header.stamp) for row in rows] == pytest.approx(moments)
