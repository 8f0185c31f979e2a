"""The IMU as a topic: rate, stamps, frames, gravity, and variances that say how wrong it is."""

import dataclasses
import math

import pytest

from sim import World, run
from sim.evidence import since_start
from sim.ros.messages.cdr import canonical
from sim.ros.messages.codec import encode
from sim.world import ImuModel, OtherRobot
from tests.students.engine import drivers

PERFECT = ImuModel(rate=50, gyro_noise=0, gyro_bias=0, accel_noise=0, accel_bias=0)
ROUGH = ImuModel(gyro_noise=0.01, gyro_bias=0.03, accel_noise=0.2, accel_bias=0.3)


def imu_of(model, driver=drivers.Watcher, seconds=2, topic="/imu/data", seed=0, **more):
    """(stamp, message) of every reading."""
    world = dataclasses.replace(World.load("yard"), imu=model, **more)
    recording = run(driver, world=world, seconds=seconds, seed=seed, quiet=True)
    assert recording.errors == []
    return [(received.stamp, received.message) for received in recording.messages(topic)]


def test_a_world_without_an_imu_has_no_topic():
    assert imu_of(None) == []


@pytest.mark.parametrize("rate", [100, 50, 40])
def test_it_speaks_at_its_rate_with_the_time_in_the_header(rate):
    readings = imu_of(dataclasses.replace(PERFECT, rate=rate))
    stamps = [stamp for stamp, _ in readings]
    assert stamps == pytest.approx([tick / rate for tick in range(2 * rate + 1)])
    assert [since_start(message.header.stamp) for _, message in readings] == stamps
    assert {message.header.frame_id for _, message in readings} == {"base_link"}


def test_at_rest_it_feels_gravity_alone():
    for _, message in imu_of(PERFECT):
        a, w, q = message.linear_acceleration, message.angular_velocity, message.orientation
        assert (a.x, a.y, a.z) == (0, 0, 9.80665)
        assert (w.x, w.y, w.z) == (0, 0, 0)
        assert (q.x, q.y, q.z, q.w) == (0, 0, 0, 1)


def test_on_a_circle_it_feels_the_turn_and_the_push_inwards():
    stamp, message = imu_of(PERFECT, drivers.Circler, seconds=3)[-1]
    assert message.angular_velocity.z == pytest.approx(0.8, abs=1e-3)
    assert message.linear_acceleration.x == pytest.approx(0, abs=1e-2)
    assert message.linear_acceleration.y == pytest.approx(0.4 * 0.8, abs=1e-2)
    yaw = 2 * math.atan2(message.orientation.z, message.orientation.w)
    assert yaw == pytest.approx(0.8 * (stamp - 0.1) - 0.8 * 0.05, abs=0.01)  # but for the ramp of 0.1 s


def test_variances_are_those_of_the_model():
    """A bias that is drawn evenly from b / 2 to b, to either side, has the variance 7/12 b^2."""
    stamp, message = imu_of(ROUGH)[-1]
    gyro, accel = 0.01**2 + 7 / 12 * 0.03**2, 0.2**2 + 7 / 12 * 0.3**2
    yaw = 7 / 12 * 0.03**2 * stamp**2 + 0.01**2 * stamp / 100
    assert list(message.angular_velocity_covariance) == pytest.approx([0] * 8 + [gyro])
    assert list(message.linear_acceleration_covariance) == pytest.approx(
        [accel, 0, 0, 0, accel, 0, 0, 0, accel]
    )
    assert list(message.orientation_covariance) == pytest.approx([0] * 8 + [yaw])


@pytest.mark.soak
def test_variances_are_as_large_as_the_errors():
    """Over many seeds: the mean square of each error at rest, beside its variance."""
    lasts = [imu_of(ROUGH, seconds=1, seed=seed)[-1][1] for seed in range(60)]
    errors = {
        "rate": ([m.angular_velocity.z for m in lasts], lasts[0].angular_velocity_covariance[8]),
        "push": ([m.linear_acceleration.x for m in lasts], lasts[0].linear_acceleration_covariance[0]),
        "turn": ([2 * m.orientation.z for m in lasts], lasts[0].orientation_covariance[8]),
    }
    for errors_of, variance in errors.values():
        assert sum(error**2 for error in errors_of) / 60 == pytest.approx(variance, rel=0.45)


def test_the_bytes_are_those_of_the_message():
    world = dataclasses.replace(World.load("yard"), imu=ROUGH)
    for received in run(drivers.Circler, world=world, seconds=1, quiet=True).messages("/imu/data"):
        assert received.raw == canonical(received.type, encode(received.message))


def test_every_robot_has_its_own():
    other = OtherRobot("other", (1.0, 1.0, 0.0))
    readings = imu_of(ROUGH, topic="/other/imu/data", robots=(other,))
    assert {message.header.frame_id for _, message in readings} == {"other/base_link"}
    assert [m.linear_acceleration for _, m in readings] != [m.linear_acceleration for _, m in imu_of(ROUGH)]
