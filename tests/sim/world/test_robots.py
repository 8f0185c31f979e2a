"""Several robots in one world: each drives, senses and is sensed by itself."""

import math
from dataclasses import replace

import numpy as np
import pytest

from sim.world import Body, LidarModel, OtherRobot, RobotModel, Simulation, World, WorldError

QUIET = LidarModel(noise=0)


def simulation(*robots, start=(0.0, 0.0, 0.0), seed=3, **more):
    return Simulation(World("test", "", (-5, -5, 5, 5), start, robots=robots, **more), seed=seed)


def drive(simulation, until, **speeds):
    """Command each named robot (v, w) at 10 Hz."""
    for tick in range(round(simulation.time * 10), round(until * 10)):
        for name, speed in speeds.items():
            simulation.robots[name].command(*speed)
        simulation.advance((tick + 1) / 10)


def test_the_first_robot_is_named_robot_and_the_others_follow_in_order():
    both = simulation(OtherRobot("zoe", (1, 0, 0)), OtherRobot("adam", (2, 0, 0)))
    assert list(both.robots) == ["robot", "zoe", "adam"]
    assert [robot.name for robot in both.robots.values()] == ["robot", "zoe", "adam"]
    assert both.world.bodies == tuple(Body(name, "robot", radius=0.1) for name in both.robots)
    assert both.poses == [(0, 0, 0), (1, 0, 0), (2, 0, 0)]


def test_each_robot_drives_by_its_own_commands():
    both = simulation(OtherRobot("leader", (0, 2, math.pi / 2)))
    drive(both, 2, leader=(0.5, 0.0))
    leader = both.robots["leader"]
    assert both.robot.pose == (0, 0, 0)
    assert leader.pose == pytest.approx((0, 2 + leader.odometry.x, math.pi / 2))
    assert leader.odometry.x == pytest.approx(0.5 * 2 - 0.065)  # 0.065 m are lost to the ramp
    assert leader.odometry[1:3] == pytest.approx((0, 0))


def test_contacts_and_the_last_scan_of_a_simulation_are_those_of_the_first_robot():
    both = simulation(OtherRobot("leader", (0, 2, 0)))
    scan = both.robot.scan()
    assert both.robot is both.robots["robot"]
    assert both.last_scan is both.robot.last_scan
    assert both.last_scan.ranges is scan
    assert both.robots["leader"].last_scan is None
    assert both.contacts == both.robot.contacts == []


def test_robots_see_each_other_as_discs_and_not_themselves():
    both = simulation(OtherRobot("leader", (1.5, 0, math.pi)), lidar=QUIET)
    robot, leader = both.robots.values()
    for eye in (robot, leader):
        scan = eye.scan()
        assert scan[0] == pytest.approx(1.4)
        assert np.isfinite(scan).sum() == 2 * math.floor(math.degrees(math.asin(0.1 / 1.5))) + 1
    drive(both, 1, leader=(0.5, 0))
    assert robot.scan()[0] == pytest.approx(leader.pose[0] - 0.1)


def test_robots_that_meet_both_feel_it():
    both = simulation(OtherRobot("leader", (1, 0, math.pi / 2)))
    drive(both, 3, robot=(0.3, 0))
    robot, leader = both.robots.values()
    (mine,), (other,) = robot.contacts, leader.contacts
    assert (mine.what, mine.side) == ("robot", "front")
    assert (other.what, other.side) == ("robot", "left")
    assert mine.stamp == other.stamp
    assert robot.bumper == {"front"} and leader.bumper == {"left"}
    assert leader.pose[0] - robot.pose[0] == pytest.approx(0.2, abs=2e-3)
    drive(both, 4, robot=(-0.3, 0))
    assert robot.bumper == leader.bumper == frozenset()
    assert robot.contacts[0].end == leader.contacts[0].end


def test_the_first_robots_noise_does_not_depend_on_the_others():
    walls = (((1.0, -5.0), (1.0, 5.0)),)
    both = simulation(OtherRobot("leader", (-3, 0, 0)), walls=walls, lidar=LidarModel(range_max=2.0))
    alone = simulation(walls=walls, lidar=LidarModel(range_max=2.0))
    assert alone.robot.scan().tobytes() == both.robot.scan().tobytes()


def test_each_robot_has_noise_of_its_own():
    walls = (((-5.0, 1.0), (5.0, 1.0)),)
    three = simulation(OtherRobot("a", (1.5, 0, 0)), OtherRobot("b", (3, 0, 0)), walls=walls)
    left = [robot.scan()[90] for robot in three.robots.values()]
    assert len(set(left)) == 3
    assert left == pytest.approx([1] * 3, abs=0.06)


def test_contacts_that_ended_can_be_forgotten():
    robot = simulation(start=(0.8, 0, 0), walls=(((1.0, -5.0), (1.0, 5.0)),))
    for until, v in ((1, 0.5), (2, -0.5), (4, 0.5)):
        drive(robot, until, robot=(v, 0))
    _, lasting = robot.contacts
    robot.robots["robot"].discard_history()
    assert robot.contacts == [lasting]
    drive(robot, 5, robot=(-0.5, 0))
    (contact,) = robot.contacts
    assert contact == lasting._replace(end=contact.end) and contact.end > 4


@pytest.mark.parametrize(
    ("start", "more", "sentence"),
    [
        (
            (0.1, 0.1, 0),
            {},
            "leader (radius 0.1 m) does not fit at the start (0.1, 0.1), where a robot is; "
            "move the start or the robot.",
        ),
        (
            (1, 0, 0),
            {"walls": (((1.05, -5.0), (1.05, 5.0)),)},
            "leader (radius 0.1 m) does not fit at the start (1, 0), where a wall is; "
            "move the start or the wall.",
        ),
    ],
)
def test_no_room_for_another_robot(start, more, sentence):
    with pytest.raises(WorldError) as caught:
        simulation(OtherRobot("leader", start), **more)
    assert str(caught.value) == f"World 'test': {sentence}"


@pytest.mark.parametrize(
    ("robots", "sentence"),
    [
        ((OtherRobot("robot", (1, 0, 0)),), "write another name for one of those named 'robot'."),
        (
            (OtherRobot("a", (1, 0, 0)), OtherRobot("a", (2, 0, 0))),
            "write another name for one of those named 'a'.",
        ),
        (
            (OtherRobot("a", (1, 0, 0)), OtherRobot("b", (1, 2, 0), ((1, 2), (1, 9)))),
            "write a start and a route for b that lie inside the bounds.",
        ),
        ((OtherRobot("a", (1, 0, 0), speed=0.7),), "write a speed of 0.6 m/s or less, the robots' max_v."),
    ],
)
def test_robots_that_cannot_be_together(robots, sentence):
    with pytest.raises(WorldError) as caught:
        replace(World.load("yard"), robots=robots)
    assert str(caught.value).startswith("World: robots is [OtherRobot(name=")
    assert str(caught.value).endswith(f"; {sentence}")


def test_a_robot_that_is_carried_away_does_not_notice_it():
    model = RobotModel(carried=[[2.0, 3.0, -1.0, 0.5], [1.0, -3.0, 1.0, math.pi / 2]])
    carried, left = simulation(robot=model), simulation()
    for one in (carried, left):
        drive(one, 1.5, robot=(0.5, 0.0))
    x, y, yaw = carried.robot.pose
    assert (x, yaw) == pytest.approx((-3.0, math.pi / 2))
    assert y == pytest.approx(1.0 + 0.5 * 0.5, abs=0.05)  # it stood still for a moment
    drive(carried, 2.0, robot=(0.0, 0.0))
    drive(carried, 3.0, robot=(0.0, 0.0))
    assert carried.robot.pose == pytest.approx((3.0, -1.0, 0.5))
    drive(left, 3.0, robot=(0.0, 0.0))
    assert carried.robot.odometry == left.robot.odometry


def test_only_the_first_robot_is_carried():
    both = simulation(OtherRobot("leader", (0, 2, 0)), robot=RobotModel(carried=[[0.5, 1.0, 1.0, 0.0]]))
    both.advance(1.0)
    assert [robot.pose for robot in both.robots.values()] == [(1.0, 1.0, 0.0), (0.0, 2.0, 0.0)]
