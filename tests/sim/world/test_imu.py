"""The IMU against closed forms: rest, ramps, circles, impacts, bias and noise."""

import math
from dataclasses import replace

import numpy as np
import pytest

from sim.world import DT, ImuModel, RobotModel, Simulation, World

GRAVITY = 9.80665
EXACT = ImuModel(gyro_noise=0, gyro_bias=0, accel_noise=0, accel_bias=0)


def simulation(model=EXACT, seed=3, start=(0.0, 0.0, 0.0), **more):
    return Simulation(World("test", "", (-5, -5, 5, 5), start, imu=model, **more), seed=seed)


def readings(moving, v, w, until, every=1):
    """One reading after every so many steps of driving at (v, w)."""
    found = []
    for step in range(round(moving.time / DT) + 1, round(until / DT) + 1):
        moving.robot.command(v, w)
        moving.advance(step * DT)
        if step % every == 0:
            found.append(moving.robot.imu())
    return found


def test_a_robot_without_an_imu_gives_no_reading():
    assert Simulation(World.load("yard")).robot.imu() is None


def test_a_stopped_robot_measures_only_gravity():
    moving = simulation()
    first = moving.robot.imu()
    assert first == (0, 0, 0, 0, 0, GRAVITY)
    assert readings(moving, 0, 0, until=0.5)[-1] == (0.5, 0, 0, 0, 0, GRAVITY)


@pytest.mark.parametrize("yaw", [0.0, 2.0])
def test_a_ramp_is_felt_as_its_acceleration(yaw):
    model = RobotModel()
    moving = simulation(start=(0, 0, yaw))
    ramp = readings(moving, 0.4, 0, until=0.2)
    assert [reading.ax for reading in ramp] == pytest.approx([model.max_acceleration] * 20, abs=1e-9)
    assert [reading.ay for reading in ramp] == pytest.approx([0] * 20, abs=1e-9)
    assert readings(moving, 0.4, 0, until=0.3)[-1].ax == pytest.approx(0, abs=1e-9)
    braking = readings(moving, 0, 0, until=0.5)
    assert [reading.ax for reading in braking] == pytest.approx([-model.max_acceleration] * 20, abs=1e-9)


@pytest.mark.parametrize(("v", "w"), [(0.4, 0.8), (0.4, -0.8), (-0.3, 2.0)])
def test_a_circle_is_felt_as_its_centripetal_acceleration(v, w):
    moving = simulation()
    readings(moving, v, w, until=1)
    for reading in readings(moving, v, w, until=4):
        assert reading.w == pytest.approx(w, abs=1e-9)
        assert reading.ax == pytest.approx(0, abs=1e-9)
        # A step's chord is shorter than its arc by (w DT)^2 / 24 of it.
        assert reading.ay == pytest.approx(v * w, rel=1e-4)


def test_yaw_is_the_sum_of_the_turns():
    moving = simulation(start=(0, 0, 1.0))
    last = readings(moving, 0.2, 1.5, until=6)[-1]
    turned = moving.robot.pose[2] - 1.0
    assert math.remainder(last.yaw - turned, math.tau) == pytest.approx(0, abs=1e-9)
    assert -math.pi < last.yaw <= math.pi


def test_slow_readings_miss_no_push():
    fast, slow = simulation(), simulation()
    each = readings(fast, 0.5, 0, until=0.5)
    mean = readings(slow, 0.5, 0, until=0.5, every=5)
    assert sum(reading.ax for reading in each) * DT == pytest.approx(0.5)
    assert sum(reading.ax for reading in mean) * 5 * DT == pytest.approx(0.5)


def test_an_impact_is_a_spike_that_takes_all_the_speed():
    moving = simulation(walls=(((0.5, -5.0), (0.5, 5.0)),))
    pushes = [reading.ax for reading in readings(moving, 0.6, 0, until=2)]
    assert all(map(math.isfinite, pushes))
    assert min(pushes) == pytest.approx(-0.6 / DT, rel=0.05)
    assert sum(pushes) * DT == pytest.approx(0, abs=1e-3)


def test_a_biased_gyro_drifts_in_proportion_to_time():
    biases = []
    for seed in range(40):
        moving = simulation(replace(EXACT, gyro_bias=0.02), seed=seed)
        by_time = {reading.stamp: reading for reading in readings(moving, 0, 0, until=1)}
        bias = by_time[1.0].w
        assert by_time[0.5].yaw == pytest.approx(bias * 0.5)
        assert by_time[1.0].yaw == pytest.approx(bias)
        biases.append(bias)
    assert -0.02 <= min(biases) < 0 < max(biases) <= 0.02


def test_a_bias_can_always_be_noticed_and_is_another_in_each_run():
    model = replace(EXACT, gyro_bias=0.02)
    sizes = [abs(readings(simulation(model, seed=seed), 0, 0, until=0.1)[-1].w) for seed in range(40)]
    assert min(sizes) >= 0.01 and max(sizes) <= 0.02
    # Mean and deviation of a uniform distribution, within five deviations of their estimates.
    deviation = 0.01 / math.sqrt(12)
    assert np.mean(sizes) == pytest.approx(0.015, abs=5 * deviation / math.sqrt(40))
    assert np.std(sizes) == pytest.approx(deviation, rel=5 * math.sqrt(0.2 / 40))


def test_every_axis_of_the_accelerometer_has_a_bias_of_its_own():
    moving = simulation(replace(EXACT, accel_bias=0.1))
    first, *_, last = readings(moving, 0, 0, until=1)
    biases = [last.ax, last.ay, last.az - GRAVITY]
    assert biases == pytest.approx([first.ax, first.ay, first.az - GRAVITY])
    assert all(0.05 <= abs(bias) <= 0.1 for bias in biases)
    assert len(set(biases)) == 3


def test_noise_is_gaussian_with_the_stated_deviation():
    moving = simulation(replace(EXACT, gyro_noise=0.01, accel_noise=0.2))
    found = readings(moving, 0, 0, until=50)
    count = len(found)
    for errors in (
        np.array([r.w for r in found]) / 0.01,
        np.array([r.ax for r in found]) / 0.2,
        np.array([r.ay for r in found]) / 0.2,
        np.array([r.az - GRAVITY for r in found]) / 0.2,
    ):
        # Five standard deviations of each estimate.
        assert abs(errors.mean()) < 5 / math.sqrt(count)
        assert abs(errors.std() - 1) < 5 / math.sqrt(2 * count)
        assert abs(np.corrcoef(errors[:-1], errors[1:])[0, 1]) < 5 / math.sqrt(count)


def test_gyro_noise_makes_yaw_walk_at_random():
    runs, steps = 200, 100
    noisy = replace(EXACT, gyro_noise=0.01)
    yaws = [readings(simulation(noisy, seed=seed), 0, 0, until=steps * DT)[-1].yaw for seed in range(runs)]
    assert np.std(yaws) == pytest.approx(0.01 * DT * math.sqrt(steps), rel=5 / math.sqrt(2 * runs))


def test_reading_twice_at_one_time_gives_the_same_reading():
    moving = simulation(ImuModel())
    moving.advance(0.1)
    first = moving.robot.imu()
    assert moving.robot.imu() is first


def test_an_imu_changes_no_other_sensor():
    room = World.load("room")
    with_imu, without = Simulation(replace(room, imu=ImuModel()), seed=3), Simulation(room, seed=3)
    for moving in (with_imu, without):
        moving.robot.command(0.5, 0.3)
        moving.advance(0.3)
        moving.robot.imu()
    assert with_imu.robot.scan().tobytes() == without.robot.scan().tobytes()
    assert with_imu.poses == without.poses
