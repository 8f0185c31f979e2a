"""The lidar against pymunk's own ray queries, and its noise against statistics."""

import math
import random
from dataclasses import replace

import numpy as np
import pymunk
import pytest

from sim.world import LidarModel, Simulation, World
from sim.world.lidar import Lidar
from tests.sim.world.mobile import MOBILE

FAR = 30.0


def by_pymunk(segments, discs, x, y, yaw, rays=360):
    """Distances by one pymunk query for each ray; inf where it meets nothing."""
    space = pymunk.Space()
    for x0, y0, x1, y1 in segments:
        space.add(pymunk.Segment(space.static_body, (x0, y0), (x1, y1), 0))
    for cx, cy, radius in discs:
        space.add(pymunk.Circle(space.static_body, radius, (cx, cy)))
    distances = []
    for ray in range(rays):
        angle = yaw + ray * math.tau / rays
        end = x + FAR * math.cos(angle), y + FAR * math.sin(angle)
        hit = space.segment_query_first((x, y), end, 0, pymunk.ShapeFilter())
        distances.append(hit.alpha * FAR if hit else math.inf)
    return distances


def cluttered(seed):
    """A walled square with random short walls and discs, and a free pose in it."""
    rng = random.Random(seed)
    h = 5.0
    segments = [(-h, -h, h, -h), (h, -h, h, h), (h, h, -h, h), (-h, h, -h, -h)]
    for _ in range(30):
        x, y, angle = rng.uniform(-h, h), rng.uniform(-h, h), rng.uniform(0, math.pi)
        segments.append((x, y, x + 0.7 * math.cos(angle), y + 0.7 * math.sin(angle)))
    x, y = rng.uniform(-1, 1), rng.uniform(-1, 1)
    discs = [(rng.uniform(-h, h), rng.uniform(-h, h), rng.uniform(0.05, 0.3)) for _ in range(12)]
    discs = [disc for disc in discs if math.dist(disc[:2], (x, y)) > disc[2] + 0.05]
    return np.array(segments), np.array(discs), (x, y, rng.uniform(-9, 9))


@pytest.mark.parametrize("seed", range(20))
def test_distances_agree_with_pymunk(seed):
    segments, discs, pose = cluttered(seed)
    distances = Lidar(LidarModel(), segments, discs).distances(*pose)
    assert distances == pytest.approx(by_pymunk(segments, discs, *pose), abs=1e-9)


@pytest.mark.parametrize("name", MOBILE)
def test_distances_agree_with_pymunk_in_every_world(name):
    world = World.load(name)
    distances = Lidar(LidarModel(), world.segments(), world.discs()).distances(*world.start)
    expected = by_pymunk(world.segments(), world.discs(), *world.start)
    assert distances == pytest.approx(expected, abs=1e-9)


def room(start=(0.0, 0.0, 0.0), **obstacles):
    return World("test", "", (-9, -9, 9, 9), start, **obstacles)


def square(half):
    corners = [(-half, -half), (half, -half), (half, half), (-half, half)]
    return tuple(zip(corners, corners[1:] + corners[:1], strict=True))


def test_ray_0_is_forward_and_the_rays_turn_counter_clockwise():
    world = room(start=(0.5, 0.2, math.pi / 2), walls=square(1))
    scan = Simulation(replace(world, lidar=LidarModel(noise=0))).robot.scan()
    assert scan.dtype == np.float32
    assert scan.shape == (360,)
    forward, left, back, right = scan[[0, 90, 180, 270]]
    assert (forward, left, back, right) == pytest.approx((0.8, 1.5, 1.2, 0.5))


def test_rays_begin_where_the_lidar_sits_and_turn_with_it():
    model = LidarModel(noise=0, x=0.08, y=0.04, yaw=math.pi / 2)
    simulation = Simulation(replace(room((0.5, 0.2, math.pi / 2), walls=square(1)), lidar=model))
    scan = simulation.robot.scan()
    assert scan[[0, 90, 180, 270]] == pytest.approx((1.46, 1.28, 0.54, 0.72))
    assert simulation.last_scan.pose == pytest.approx((0.46, 0.28, math.pi))


def test_rays_through_the_corners_of_a_room_do_not_leak():
    scan = Simulation(replace(room(walls=square(1)), lidar=LidarModel(noise=0))).robot.scan()
    assert scan[[45, 135, 225, 315]] == pytest.approx([math.sqrt(2)] * 4)
    assert np.isfinite(scan).all()


def test_a_wall_seen_end_on_is_invisible():
    world = room(walls=(((0.5, 0.0), (1.0, 0.0)), ((2.0, -1.0), (2.0, 1.0))))
    scan = Simulation(replace(world, lidar=LidarModel(noise=0))).robot.scan()
    assert scan[0] == pytest.approx(2.0)


def test_the_edge_of_a_disc_is_its_tangent():
    tangent = (math.sqrt(2), 0, 1.0)  # seen under 45 degrees to either side, from 1 m
    lidar = Lidar(LidarModel(), np.empty((0, 4)), np.array([tangent]))
    distances = lidar.distances(0, 0, 0)
    assert distances[[45, 315]] == pytest.approx([1.0, 1.0], abs=1e-6)
    assert distances[0] == pytest.approx(math.sqrt(2) - 1)
    assert np.isinf(distances[46:315]).all()


def test_nothing_within_range_is_inf_and_too_near_is_minus_inf():
    model = LidarModel(noise=0)
    walls = (((0.11, -0.05), (0.11, 0.05)), ((-4.0, -1.0), (-4.0, 1.0)), ((-1.0, 3.49), (1.0, 3.49)))
    lidar = Lidar(model, room(walls=walls).segments(), np.empty((0, 3)))
    scan = lidar.measure(0, 0, 0, np.random.default_rng(1))
    assert scan[0] == -math.inf
    assert scan[180] == math.inf
    assert scan[90] == pytest.approx(3.49)
    assert scan[270] == math.inf


def test_an_empty_yard_gives_inf_all_round():
    assert np.isposinf(Simulation(World.load("yard"), seed=3).robot.scan()).all()


def test_noise_is_gaussian_with_the_stated_deviation():
    world = room(walls=square(1.5))
    simulation = Simulation(world, seed=3)
    true = Simulation(replace(world, lidar=LidarModel(noise=0))).robot.scan()
    errors = np.array([simulation.robot.scan() - true for _ in range(200)]) / LidarModel().noise
    count = errors.size
    # Five standard deviations of each estimate.
    assert abs(errors.mean()) < 5 / math.sqrt(count)
    assert abs(errors.std() - 1) < 5 / math.sqrt(2 * count)
    assert (np.abs(errors) < 1).mean() == pytest.approx(math.erf(1 / math.sqrt(2)), abs=0.01)
    neighbors = np.corrcoef(errors[:, :-1].ravel(), errors[:, 1:].ravel())[0, 1]
    assert abs(neighbors) < 5 / math.sqrt(count)


def test_each_scan_has_new_noise():
    simulation = Simulation(room(walls=square(1)), seed=3)
    assert (simulation.robot.scan() != simulation.robot.scan()).mean() > 0.99


def test_dropouts_are_nan_and_as_frequent_as_stated():
    simulation = Simulation(replace(room(walls=square(1)), lidar=LidarModel(dropouts=0.1)), seed=3)
    lost = np.isnan([simulation.robot.scan() for _ in range(200)])
    assert abs(lost.mean() - 0.1) < 5 * math.sqrt(0.1 * 0.9 / lost.size)
    # Each ray of each scan on its own.
    assert abs(np.corrcoef(lost[:, :-1].ravel(), lost[:, 1:].ravel())[0, 1]) < 5 / math.sqrt(lost.size)
    assert abs(np.corrcoef(lost[:-1].ravel(), lost[1:].ravel())[0, 1]) < 5 / math.sqrt(lost.size)


def test_rays_that_are_not_lost_measure_as_without_dropouts():
    world = room(walls=square(1))
    scan = Simulation(world, seed=3).robot.scan()
    dropped = Simulation(replace(world, lidar=LidarModel(dropouts=0.3)), seed=3).robot.scan()
    there = ~np.isnan(dropped)
    assert 200 < there.sum() < 300
    assert (scan[there] == dropped[there]).all()


def test_a_lidar_of_one_ray_looks_forward():
    world = replace(room(walls=square(1)), lidar=LidarModel(rays=1, noise=0))
    assert Simulation(world).robot.scan() == pytest.approx([1.0])
