"""Imperfect wheels: the odometry drifts by what the model says, and its covariance says so, too."""

import math
import random
from dataclasses import replace
from statistics import fmean

import numpy as np
import pytest

from sim.world import Simulation, WheelModel, World

YARD = World("test", "", (-50, -50, 50, 50))
ROUGH = WheelModel(radius_error=0.002, track_error=0.01, slip=0.002, ticks=1000)


def driven(model, seed=0, seconds=8.0, commands=None):
    """The robot after a drive at random, or with the same command all the time."""
    simulation, draw = Simulation(replace(YARD, wheels=model), seed=seed), random.Random(seed)
    command = commands
    for step in range(round(seconds * 20)):
        if commands is None and step % 30 == 0:
            command = draw.uniform(-0.1, 0.5), draw.uniform(-1.0, 1.0)
        simulation.robot.command(*command)
        simulation.advance((step + 1) / 20)
    return simulation.robot


def error(robot):
    """What must be added to the odometry's pose to get the true pose."""
    counted, (x, y, yaw) = robot.odometry, robot.pose
    return np.array([x - counted.x, y - counted.y, math.remainder(yaw - counted.yaw, math.tau)])


def velocity_error(robot):
    c, s = math.cos(robot.body.angle), math.sin(robot.body.angle)
    v = c * robot.body.velocity.x + s * robot.body.velocity.y
    return np.array([v - robot.odometry.v, robot.body.angular_velocity - robot.odometry.w])


def nees(off, covariance):
    """The squared error in units of its covariance: on average the number of dimensions, if it's honest."""
    return off @ np.linalg.solve(np.reshape(covariance, (len(off), len(off))), off)


def test_wheels_without_an_error_are_those_of_a_robot_without_the_option():
    plain, robot = driven(None), driven(WheelModel())
    assert robot.pose == pytest.approx(plain.pose, abs=1e-9)
    assert robot.odometry == pytest.approx(plain.odometry, abs=1e-9)
    assert robot.wheels == pytest.approx(plain.wheels, abs=1e-9)
    assert set(robot.pose_covariance) == set(robot.twist_covariance) == {0.0}


@pytest.mark.parametrize("model", [
    WheelModel(slip=0.003),
    WheelModel(slip=0.002, radius_error=0.002),
    WheelModel(slip=0.002, track_error=0.02),
    ROUGH,
])  # fmt: skip
def test_the_covariance_is_as_large_as_the_errors(model):
    """Over 80 runs the mean of 3 dimensions is within four of its standard deviations of 3."""
    robots = [driven(model, seed) for seed in range(80)]
    assert max(np.linalg.norm(error(robot)) for robot in robots) > 0.02
    spread = 4 * math.sqrt(2 * 3 / 80)
    assert fmean(nees(error(robot), robot.pose_covariance) for robot in robots) == pytest.approx(
        3, abs=spread
    )
    spread = 4 * math.sqrt(2 * 2 / 80)
    velocities = [nees(velocity_error(robot), robot.twist_covariance) for robot in robots]
    assert fmean(velocities) == pytest.approx(2, abs=spread)


def test_straight_ahead_the_variances_are_those_of_the_formula():
    """Each wheel's variance grows by slip^2 a meter; their difference turns the robot, and moves it aside."""
    robot = driven(WheelModel(slip=0.004), seconds=10, commands=(0.5, 0.0))
    rolled, track = robot.odometry.x, 0.16
    assert robot.odometry.yaw == 0.0
    xx, xy, xt, yx, yy, yt, tx, ty, tt = robot.pose_covariance
    assert xx == pytest.approx(0.004**2 * rolled / 2)
    assert tt == pytest.approx(2 * 0.004**2 * rolled / track**2)
    assert yy == pytest.approx(tt * rolled**2 / 3, rel=1e-3)
    assert yt == pytest.approx(tt * rolled / 2, rel=1e-3)
    assert (xy, xt) == pytest.approx((0, 0)) and (yx, tx, ty) == (xy, xt, yt)


def test_a_constant_error_grows_with_the_distance_and_not_with_its_root():
    near, far = (driven(WheelModel(radius_error=0.003), seconds=s, commands=(0.5, 0.0)) for s in (4, 8))
    ratio = far.odometry.x / near.odometry.x
    assert far.pose_covariance[8] / near.pose_covariance[8] == pytest.approx(ratio**2)
    assert abs(error(far)[2]) / abs(error(near)[2]) == pytest.approx(ratio)


def test_while_it_stands_its_covariance_stays():
    simulation = Simulation(replace(YARD, wheels=ROUGH), seed=1)
    for step in range(60):
        simulation.robot.command(0.4, 0.5)
        simulation.advance((step + 1) / 20)
    simulation.advance(4.0)
    before = simulation.robot.pose_covariance
    simulation.advance(60.0)
    assert simulation.robot.pose_covariance == before
    assert before[0] > 0.0


def test_an_encoder_reads_whole_ticks():
    robot = driven(WheelModel(ticks=360), commands=(0.3, 0.4))
    for angle in robot.wheels[:2]:
        assert math.degrees(angle) == pytest.approx(round(math.degrees(angle)))
    exact = driven(WheelModel(), commands=(0.3, 0.4))
    assert robot.pose == exact.pose
    assert robot.wheels[:2] == pytest.approx(exact.wheels[:2], abs=math.radians(0.51))
    assert 0 < abs(robot.wheels.left_rate - exact.wheels.left_rate) < math.radians(1) / 0.05


def test_a_stopped_encoder_has_no_rate():
    simulation = Simulation(replace(YARD, wheels=WheelModel(ticks=100)))
    simulation.robot.command(0.3, 0.4)
    simulation.advance(3)
    assert simulation.robot.wheels[2:] == simulation.robot.odometry[3:] == (0, 0)


@pytest.mark.parametrize(("model", "turned"), [
    (WheelModel(left_scale=1.05), -0.05),
    (WheelModel(right_scale=1.05), 0.05),
    (WheelModel(track_scale=1.1), 0.0),
])  # fmt: skip
def test_a_fault_is_in_no_covariance(model, turned):
    """The robot drives a curve that its odometry knows nothing about."""
    robot = driven(model, commands=(0.3, 0.0))
    assert robot.odometry.yaw == 0.0
    assert robot.body.angle == pytest.approx(turned * robot.odometry.x / 0.16, rel=1e-6)
    assert set(robot.pose_covariance) == {0.0}


def test_a_wider_track_turns_less():
    robot = driven(WheelModel(track_scale=1.1), commands=(0.0, 1.0))
    simulation_turn = robot.wheels.right * 0.033 / 0.08
    assert robot.body.angle == pytest.approx(simulation_turn / 1.1)


def test_the_seed_decides_and_each_robot_has_its_own():
    assert driven(ROUGH, 1).pose == driven(ROUGH, 1).pose != driven(ROUGH, 2).pose
