"""What a robot was told, and how fast it went: the evidence for the checks of 12_safety."""

from __future__ import annotations

import itertools
import math

from grader.checks import Missed
from grader.checks.no_data import no_data
from sim.evidence import Message, Recording, Seconds

OUT, TWIST = "/cmd_vel", "geometry_msgs/msg/Twist"
STANDING, TURNING = 0.02, 0.1  # m/s, rad/s
SAME = 1e-3  # m/s, rad/s


def ours(run: Recording, topic: str, at_least: int = 1) -> list[Message]:
    """What our nodes said on a topic. Raises as `no_data` does for fewer messages."""
    said = [heard for heard in run.messages(topic) if heard.from_course]
    if len(said) < at_least:
        raise no_data(run, f"messages on {topic}", f"{len(said)}", run.graph.publishers(topic))
    return said


def last(messages: list[Message], stamp: Seconds) -> Message | None:
    """The last of them that is not later."""
    return next((heard for heard in reversed(messages) if heard.stamp <= stamp + 1e-6), None)


def speeds(heard: Message) -> tuple[float, float]:
    """Those of a command, m/s and rad/s."""
    return heard.message.linear.x, heard.message.angular.z


def alike(one: tuple[float, float], other: tuple[float, float]) -> bool:
    """Whether both commands are the same; NaN is like nothing."""
    return all(abs(a - b) < SAME for a, b in zip(one, other, strict=True))


def told(command: tuple[float, float]) -> str:
    """A command in words."""
    return f"linear.x {command[0]:.3g}, angular.z {command[1]:.3g}"


def must_stand(run: Recording, begin: Seconds, end: Seconds, why: str, hint: str) -> None:
    """Raises Missed, and calls it unsafe, where the robot moves between two moments."""
    path = run.during(begin, end + 1e-6).path
    for a, b in itertools.pairwise(path):
        seconds = b.stamp - a.stamp
        speed, turn = (
            math.dist(a[1:3], b[1:3]) / seconds,
            abs(math.remainder(b.yaw - a.yaw, math.tau)) / seconds,
        )
        if speed > STANDING or turn > TURNING:
            saw = f"{speed:.2f} m/s and {turn:.2f} rad/s at {b.stamp:.3g} s"
            raise Missed(f"the robot standing, {why}", saw, hint, picture="topics", unsafe=True)
