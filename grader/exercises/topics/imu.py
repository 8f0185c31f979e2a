"""An IMU: rate, header, acceleration and orientation."""

import math

from grader.checks import Missed, publishes, rate, within
from grader.checks.fields import stamp_words
from grader.exercise import Exercise
from grader.geometry.near import is_near
from grader.variants import Variants
from sim.evidence import Message, Recording, since_start

imu = Exercise("imu", "An IMU", seconds=3, extra_allowed=True, variants=Variants(
    {"rate": (100, 50, 200), "period": (0.01, 0.02, 0.005)},
    {"frame": ("imu_link", "imu_sensor", "body_imu")},
    texts=("at {rate} Hz", "{rate} times a second", "create_timer({period:g}, ", "{frame}"),
    elsewhere=("{rate} times a second",),
))
IMU = "/imu/data"
LEFT = math.sqrt(0.5)  # z and w of the quaternion that says so


@imu.check(3)
def imu_is_published(run: Recording) -> list[Message]:
    """The node publishes Imu messages on /imu/data."""
    return publishes(run, IMU, "sensor_msgs/msg/Imu")


@imu.check(4, after=imu_is_published)
def imu_at_100_hz(run: Recording) -> None:
    """They come at 100 Hz."""
    rate(run, IMU, float(imu.drawn.rate), tolerance=0.05)


@imu.check(2, after=imu_is_published)
def imu_names_its_frame(run: Recording, sent: list[Message]) -> None:
    """The header's frame_id is imu_link."""
    wanted = imu.drawn.frame
    for row in sent:
        frame = row.message.header.frame_id
        if frame != wanted:
            hint = f'Set it before publish(): msg.header.frame_id = "{wanted}".'
            if frame == f"/{wanted}":
                hint = "A frame's name doesn't begin with a slash."
            saw = f"“{frame}” at {row.stamp:.3g} s"
            raise Missed(f"header.frame_id “{wanted}” in every message", saw, hint)


@imu.check(3, after=imu_is_published)
def imu_is_stamped(run: Recording, sent: list[Message]) -> None:
    """The header's stamp is the time at which the message is sent."""
    for row in sent:
        stamp = row.message.header.stamp
        if not is_near(since_start(stamp), row.stamp, 0.02):
            expected = f"the stamp {row.stamp:.3f} s (since the start) in the message sent at that time"
            hint = "In the timer's callback: msg.header.stamp = self.get_clock().now().to_msg()."
            raise Missed(expected, stamp_words(stamp), hint)


@imu.check(2, after=imu_is_published, guess="msg.linear_acceleration.z = 9.81: up is positive.")
def imu_feels_gravity(run: Recording) -> None:
    """The acceleration along z is 9.81 m/s²."""
    within(run, IMU, "linear_acceleration.z", 9.71, 9.91, unit="m/s²")


@imu.check(3, after=imu_is_published)
def imu_looks_left(run: Recording, sent: list[Message]) -> None:
    """The orientation is a unit quaternion for a robot turned 90 degrees to the left."""
    for row in sent:
        q = row.message.orientation
        length = math.hypot(q.x, q.y, q.z, q.w)
        if not is_near(length, 1.0, 0.01):
            expected = "a quaternion of length 1"
            hint = ("The numbers in a quaternion aren't angles: z = math.sin(yaw / 2), w = math.cos(yaw / "
                    "2), x = y = 0.")
            raise Missed(expected, f"length {length:.3g} at {row.stamp:.3g} s: {_text(q)}", hint)
        if abs(q.z * LEFT + q.w * LEFT) < 0.999:  # 1 for the same rotation, with either sign
            expected = f"the quaternion {_text(type(q)(z=LEFT, w=LEFT))}"
            hint = ("90 degrees to the left is a yaw of pi/2: z = math.sin(yaw / 2), w = math.cos(yaw / "
                    "2).")
            raise Missed(expected, f"{_text(q)} at {row.stamp:.3g} s", hint, credit=1 / 3)


def _text(quaternion: object) -> str:
    return ", ".join(f"{name} {getattr(quaternion, name):.3g}" for name in "xyzw")
