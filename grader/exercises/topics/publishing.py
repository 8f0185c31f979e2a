"""Exercises on publishers: a first one, a thermometer, an IMU."""

from __future__ import annotations

import itertools
import math

from grader.checks import Missed, check, publishes, rate, series, within
from grader.exercise import Exercise
from grader.exercises.advice import advising
from sim.recording import Recording


@check(points=5)
def says_something(recording: Recording) -> None:
    """The node publishes String messages on /greeting."""
    publishes(recording, "/greeting", "std_msgs/msg/String")


@check(points=3, after=says_something)
def says_it_twice_a_second(recording: Recording) -> None:
    """A greeting goes out twice a second."""
    rate(recording, "/greeting", 2.0)


greeting = Exercise(
    "greeting",
    "A publisher in one line",
    [says_something, says_it_twice_a_second],
    seconds=5,
)


TEMPERATURE = "/sensor/temperature"


@check(points=5)
def temperature_is_published(recording: Recording) -> None:
    """The node publishes Float32 messages on /sensor/temperature."""
    publishes(recording, TEMPERATURE, "std_msgs/msg/Float32")


@check(points=4, after=temperature_is_published)
def temperature_once_a_second(recording: Recording) -> None:
    """A temperature comes once a second."""
    rate(recording, TEMPERATURE, 1.0)


@check(points=4, after=temperature_is_published)
def temperature_in_range(recording: Recording) -> None:
    """Every temperature is from 20 to 25 °C."""
    with advising(recording, "random.uniform(20.0, 25.0) gives a number in this range."):
        within(recording, TEMPERATURE, "data", 20.0, 25.0, unit="°C")


@check(points=2, after=temperature_is_published)
def temperature_changes(recording: Recording) -> None:
    """The temperature changes from message to message."""
    values = [value for _, value in series(recording, TEMPERATURE, "data")]
    same = sum(before == after for before, after in itertools.pairwise(values))
    if len(values) < 2 or same > len(values) / 2:
        raise Missed(
            "a new temperature in each message",
            f"only {values[0]:.4g} °C" if len(set(values)) == 1 else f"{same} times the same as before",
            "Ask for a new number in the timer's callback: random.uniform(20.0, 25.0) gives one.",
        )


temperature = Exercise(
    "temperature",
    "A thermometer",
    [temperature_is_published, temperature_once_a_second, temperature_in_range, temperature_changes],
    seconds=10,
)


IMU_TOPIC = "/imu/data"


@check(points=3)
def imu_is_published(recording: Recording) -> None:
    """The node publishes Imu messages on /imu/data."""
    publishes(recording, IMU_TOPIC, "sensor_msgs/msg/Imu")


@check(points=4, after=imu_is_published)
def imu_at_100_hz(recording: Recording) -> None:
    """They come at 100 Hz."""
    rate(recording, IMU_TOPIC, 100.0, tolerance=0.05)


@check(points=2, after=imu_is_published)
def imu_names_its_frame(recording: Recording) -> None:
    """The header's frame_id is imu_link."""
    for stamp, frame in series(recording, IMU_TOPIC, "header.frame_id"):
        if frame != "imu_link":
            hint = "A frame's name has no slash in front." if frame == "/imu_link" else ""
            raise Missed(
                "header.frame_id “imu_link” in every message",
                f"“{frame}” at {stamp:.3g} s",
                hint or 'Set it before publish(): msg.header.frame_id = "imu_link".',
            )


@check(points=3, after=imu_is_published)
def imu_is_stamped(recording: Recording) -> None:
    """The header's stamp is the time at which the message is sent."""
    for heard in recording.messages(IMU_TOPIC):
        stamp = heard.message.header.stamp
        seconds = stamp.sec + stamp.nanosec / 1e9
        if abs(seconds - heard.stamp) > 0.02:
            raise Missed(
                f"a stamp of {heard.stamp:.3g} s in the message sent at {heard.stamp:.3g} s",
                f"{seconds:.10g} s",
                "In the timer's callback: msg.header.stamp = self.get_clock().now().to_msg().",
            )


@check(points=2, after=imu_is_published)
def imu_feels_gravity(recording: Recording) -> None:
    """The acceleration along z is 9.81 m/s²."""
    with advising(recording, "msg.linear_acceleration.z = 9.81; upwards is positive."):
        within(recording, IMU_TOPIC, "linear_acceleration.z", 9.71, 9.91, unit="m/s²")


@check(points=3, after=imu_is_published)
def imu_looks_left(recording: Recording) -> None:
    """The orientation is a unit quaternion that says: turned 90 degrees to the left."""
    for heard in recording.messages(IMU_TOPIC):
        q = heard.message.orientation
        length = math.hypot(q.x, q.y, q.z, q.w)
        if not abs(length - 1.0) < 0.01:
            raise Missed(
                "a quaternion of length 1",
                f"length {length:.3g} at {heard.stamp:.3g} s: {_quaternion(q)}",
                "A quaternion holds no angles: z = math.sin(yaw / 2), w = math.cos(yaw / 2), x = y = 0.",
            )
        half = math.sqrt(0.5)
        if abs(q.z * half + q.w * half) < 0.999:  # 1 for the same rotation, with either sign
            raise Missed(
                f"the quaternion {_quaternion(type(q)(z=half, w=half))}",
                f"{_quaternion(q)} at {heard.stamp:.3g} s",
                "yaw is pi/2 to the left; z = math.sin(yaw / 2), w = math.cos(yaw / 2), with yaw in radians.",
                credit=1 / 3,
            )


def _quaternion(q: object) -> str:
    return ", ".join(f"{name} {getattr(q, name):.3g}" for name in "xyzw")


imu = Exercise(
    "imu",
    "An IMU",
    [
        imu_is_published,
        imu_at_100_hz,
        imu_names_its_frame,
        imu_is_stamped,
        imu_feels_gravity,
        imu_looks_left,
    ],
    seconds=3,
)
