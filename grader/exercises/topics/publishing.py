"""Exercises on publishers: a first one, a thermometer, an IMU."""

from __future__ import annotations

import itertools
import math

from grader.checks import Missed, publishes, rate, within
from grader.checks.fields import stamp_words
from grader.exercise import Exercise
from sim.evidence import Message, Recording, since_start

greeting = Exercise("greeting", "A publisher in one line", seconds=5)


@greeting.check(5)
def says_something(run: Recording) -> None:
    """The node publishes String messages on /greeting."""
    publishes(run, "/greeting", "std_msgs/msg/String")


@greeting.check(3, after=says_something)
def says_it_twice_a_second(run: Recording) -> None:
    """A greeting goes out twice a second."""
    rate(run, "/greeting", 2.0)


temperature = Exercise("temperature", "A thermometer", seconds=10)
TEMPERATURE = "/sensor/temperature"


@temperature.check(5)
def temperature_is_published(run: Recording) -> list[Message]:
    """The node publishes Float32 messages on /sensor/temperature."""
    return publishes(run, TEMPERATURE, "std_msgs/msg/Float32")


@temperature.check(4, after=temperature_is_published)
def temperature_once_a_second(run: Recording) -> None:
    """A temperature comes once a second."""
    rate(run, TEMPERATURE, 1.0)


@temperature.check(
    4, after=temperature_is_published, guess="random.uniform(20.0, 25.0) gives a number in this range."
)
def temperature_in_range(run: Recording) -> list[float]:
    """Every temperature is from 20 to 25 °C."""
    return within(run, TEMPERATURE, "data", 20.0, 25.0, unit="°C")


@temperature.check(2, after=(temperature_is_published, temperature_in_range))
def temperature_changes(run: Recording, sent: list[Message], _: list[float]) -> None:
    """The temperature changes from message to message."""
    values = [heard.message.data for heard in sent]
    same = sum(before == after for before, after in itertools.pairwise(values))
    if len(values) < 2 or same > len(values) / 2:
        raise Missed(
            "a new temperature in each message",
            f"only {values[0]:.4g} °C" if len(set(values)) == 1 else f"{same} times the same as before",
            "Ask for a new number in the timer's callback: random.uniform(20.0, 25.0) gives one.",
        )


imu = Exercise("imu", "An IMU", seconds=3, extra_allowed=True)
IMU = "/imu/data"
LEFT = math.sqrt(0.5)  # z and w of the quaternion that says so


@imu.check(3)
def imu_is_published(run: Recording) -> list[Message]:
    """The node publishes Imu messages on /imu/data."""
    return publishes(run, IMU, "sensor_msgs/msg/Imu")


@imu.check(4, after=imu_is_published)
def imu_at_100_hz(run: Recording) -> None:
    """They come at 100 Hz."""
    rate(run, IMU, 100.0, tolerance=0.05)


@imu.check(2, after=imu_is_published)
def imu_names_its_frame(run: Recording, sent: list[Message]) -> None:
    """The header's frame_id is imu_link."""
    for heard in sent:
        frame = heard.message.header.frame_id
        if frame != "imu_link":
            hint = 'Set it before publish(): msg.header.frame_id = "imu_link".'
            if frame == "/imu_link":
                hint = "A frame's name has no slash in front."
            saw = f"“{frame}” at {heard.stamp:.3g} s"
            raise Missed("header.frame_id “imu_link” in every message", saw, hint)


@imu.check(3, after=imu_is_published)
def imu_is_stamped(run: Recording, sent: list[Message]) -> None:
    """The header's stamp is the time at which the message is sent."""
    for heard in sent:
        stamp = heard.message.header.stamp
        if abs(since_start(stamp) - heard.stamp) > 0.02:
            raise Missed(
                f"a stamp of {heard.stamp:.3f} s after the start in the message sent then",
                stamp_words(stamp),
                "In the timer's callback: msg.header.stamp = self.get_clock().now().to_msg().",
            )


@imu.check(2, after=imu_is_published, guess="msg.linear_acceleration.z = 9.81; upwards is positive.")
def imu_feels_gravity(run: Recording) -> None:
    """The acceleration along z is 9.81 m/s²."""
    within(run, IMU, "linear_acceleration.z", 9.71, 9.91, unit="m/s²")


@imu.check(3, after=imu_is_published)
def imu_looks_left(run: Recording, sent: list[Message]) -> None:
    """The orientation is a unit quaternion that says: turned 90 degrees to the left."""
    for heard in sent:
        q = heard.message.orientation
        length = math.hypot(q.x, q.y, q.z, q.w)
        if not abs(length - 1.0) < 0.01:
            raise Missed(
                "a quaternion of length 1",
                f"length {length:.3g} at {heard.stamp:.3g} s: {_in_words(q)}",
                "A quaternion holds no angles: z = math.sin(yaw / 2), w = math.cos(yaw / 2), x = y = 0.",
            )
        if abs(q.z * LEFT + q.w * LEFT) < 0.999:  # 1 for the same rotation, with either sign
            raise Missed(
                f"the quaternion {_in_words(type(q)(z=LEFT, w=LEFT))}",
                f"{_in_words(q)} at {heard.stamp:.3g} s",
                "yaw is pi/2 to the left; z = math.sin(yaw / 2), w = math.cos(yaw / 2), with yaw in radians.",
                credit=1 / 3,
            )


def _in_words(quaternion: object) -> str:
    return ", ".join(f"{name} {getattr(quaternion, name):.3g}" for name in "xyzw")
