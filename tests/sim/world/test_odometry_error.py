"""How far the odometry may be off: nothing until something touches the robot, and about what it is then."""

import math
import random

import pytest

from sim.world import World
from sim.world.odometry_error import TURNED
from sim.world.simulation import Simulation


def driven(world, seed, seconds):
    """A drive at random; yields the robot, and how far its odometry is off (m, rad)."""
    simulation, draw = Simulation(world, seed=seed), random.Random(seed)
    x0, y0, yaw0 = world.start
    for step in range(round(seconds * 10)):
        if step % 15 == 0:
            command = draw.uniform(-0.6, 0.6), draw.uniform(-1.5, 1.5)
        simulation.robot.command(*command)
        simulation.advance((step + 1) / 10)
        counted, (x, y, yaw) = simulation.robot.odometry, simulation.robot.pose
        cos, sin = math.cos(yaw0), math.sin(yaw0)
        off = x - x0 - cos * counted.x + sin * counted.y, y - y0 - sin * counted.x - cos * counted.y
        yield simulation.robot, math.hypot(*off), abs(math.remainder(yaw - yaw0 - counted.yaw, math.tau))


def test_odometry_is_exact_until_something_touches_the_robot():
    for robot, place, turn in driven(World.load("yard"), 1, 60):
        assert not robot.contacts
        error = robot.odometry_error
        assert (error.place, error.turn, error.speed, error.rate) == (0.0, 0.0, 0.0, 0.0)
        assert max(place, turn) < 1e-9


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_once_it_was_touched_the_error_is_about_what_is_estimated(seed):
    rows = list(driven(World.generate("maze", seed=seed), seed, 60))
    robot, place, turn = rows[-1]
    assert robot.contacts and place > 1.0
    assert place < robot.odometry_error.place < 3 * place
    assert turn < 2 * robot.odometry_error.turn == 2 * TURNED


def test_while_it_pushes_a_wall_all_of_its_speed_may_be_wrong():
    simulation = Simulation(World.load("room"), seed=1)
    robot, places = simulation.robot, []
    for step in range(1, 301):
        robot.command(0.4, 0.0)
        simulation.advance(step / 10)
        assert robot.odometry_error.speed == (robot.odometry.v if robot.contacts else 0.0)
        places.append(robot.pose[:2])
    assert math.dist(*places[-2:]) < 0.001
    assert robot.odometry.v == robot.odometry_error.speed == pytest.approx(0.4)
