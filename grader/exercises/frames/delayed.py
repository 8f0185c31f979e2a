"""An exercise on transforms that come late: wait for them, without standing in the way of others."""

from __future__ import annotations

import math
import random

from geometry_msgs.msg import PointStamped
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import TransformBroadcaster

from grader.checks import Missed, hinting, publishes, subscribes
from grader.checks.no_data import no_data
from grader.exercise import Exercise
from grader.exercises.frames.partners import Flat, transform
from sim.evidence import Message, Recording, since_start

POINT = "geometry_msgs/msg/PointStamped"
NEAR, SOON = 0.03, 1.2  # m, s
OFTEN, ELSEWHERE = 0.4, 0.3  # of the points, where it is said more than once, or of an earlier moment
SWERVE = 0.04  # m, from one moment to the next


class SlowLocalization(Node):
    """A robot on a curve. What it sees it tells at once (/detection), and where it was (/tf) 0.5 s later.

    The run's seed decides on the curve and on what is seen.
    """

    def __init__(self) -> None:
        super().__init__("slow_localization")
        self.broadcaster = TransformBroadcaster(self)
        self.publisher = self.create_publisher(PointStamped, "/detection", 10)
        self.phase, self.delay = random.uniform(-3.0, 3.0), random.choice((8, 10, 12))
        self.waiting: list[tuple[Time, Flat]] = []
        self.aside = 0.0  # m off the circle: who drives swerves, and nobody knows beforehand where to
        self.ticks = 0
        self.create_timer(0.05, self.tick)

    def tick(self) -> None:
        """Measure now, say what was measured a while ago, and see something now and then."""
        now = self.get_clock().now()
        self.aside += random.uniform(-SWERVE, SWERVE)
        x, y, yaw = self.where(now)
        self.waiting.append((now, (x + self.aside, y - self.aside, yaw)))
        if len(self.waiting) > self.delay:
            then, place = self.waiting.pop(0)
            self.broadcaster.sendTransform(transform("map", "base_link", place, then))
        self.ticks += 1
        if self.ticks % 8 == 0 and self.ticks > self.delay:
            self.see(now)

    def where(self, when: Time) -> Flat:
        """A circle, driven at 1 m/s; the robot swerves on it."""
        angle = self.phase + 0.5 * since_start(when.to_msg())
        return 2.0 * math.cos(angle), 2.0 * math.sin(angle), math.remainder(angle + math.pi / 2, math.tau)

    def see(self, now: Time) -> None:
        """See something ahead."""
        point = PointStamped()
        point.header.frame_id, point.header.stamp = "base_link", now.to_msg()
        point.point.x, point.point.y = random.uniform(0.5, 2.0), random.uniform(-1.0, 1.0)
        self.publisher.publish(point)


delayed = Exercise("delayed", "Too early to ask", seconds=6, companions=[SlowLocalization], seeds=(1, 2))


@delayed.check(2)
def hears_detections(run: Recording) -> None:
    """The node hears /detection (PointStamped) and /tf."""
    with hinting(guess="A TransformListener hears /tf: TransformListener(self.buffer, self)."):
        subscribes(run, "/detection", POINT)
        subscribes(run, "/tf")


@delayed.check(10, after=hears_detections)
def places_them(run: Recording) -> None:
    """Each detection comes out on /found (PointStamped), once and within 1.2 s: where it was then, in map."""
    hint = (
        "The transform comes half a second after the detection: keep the detection, and look again later. A "
        "callback that waits for it in a loop keeps its own node from hearing. Each is known by its stamp."
    )
    with hinting(hint):
        publishes(run, "/found", POINT)
    seen, found = _seen(run), run.messages("/found")
    answered = [sum(_same(one, other) for other in found if other.stamp < one.stamp + SOON) for one in seen]
    missing = [one for one, count in zip(seen, answered, strict=True) if count != 1]
    if missing:
        saw, credit = f"{sum(count == 1 for count in answered)} of {len(seen)}", 0.0
        if max(answered) > 1:
            saw, credit = f"{max(answered)} for one of them", OFTEN if min(answered) else 0.0
        _where_they_are(run)
        expected = f"one message for each of {len(seen)} detections, with its stamp"
        raise Missed(expected, saw, hint, credit=credit)
    _where_they_are(run)


@delayed.check(4, after=places_them)
def waits_no_longer_than_needed(run: Recording) -> None:
    """It comes out as soon as its transform has come, within 0.2 s."""
    for seen in _seen(run):
        ready = next(stamp for stamp, when, _ in _robot(run) if when >= _when(seen) - 1e-6)
        one = next((one for one in run.messages("/found") if _same(seen, one)), None)
        if one is not None and one.stamp < ready - 1e-6:
            hint = "Nobody knew then where the robot had been. Wait for the time of the detection."
            expected = f"the detection of {seen.stamp:.3g} s on /found not before {ready:.3g} s"
            raise Missed(expected, f"at {one.stamp:.3g} s", hint)
        if one is not None and one.stamp > ready + 0.2:
            expected = f"the detection of {seen.stamp:.3g} s on /found by {ready + 0.2:.3g} s"
            hint = "Look again in a timer of 0.05 s, or await what wait_for_transform_async gives."
            raise Missed(expected, f"at {one.stamp:.3g} s", hint)


def _where_they_are(run: Recording) -> None:
    """Raises Missed for the first that is at another place."""
    found = run.messages("/found")
    for seen in _seen(run):
        one = next((one for one in found if _same(seen, one)), None)
        if one is None:
            continue
        wanted, said = _place(run, seen), (one.message.point.x, one.message.point.y)
        if one.message.header.frame_id != "map" or not math.dist(said, wanted) <= NEAR:
            expected = f"({wanted[0]:.2f}, {wanted[1]:.2f}) m in map, for the detection at {seen.stamp:.3g} s"
            told = f"({said[0]:.2f}, {said[1]:.2f}) m in {one.message.header.frame_id or 'no frame'}"
            hint = (
                "Time() asks for the newest transform that has come, and that one is half a second old: the "
                "robot was elsewhere. Wait for the time of the detection, msg.header.stamp."
            )
            once = math.dist(said, _seen_from(_newest(run, seen), seen)) <= NEAR
            raise Missed(expected, told, hint, credit=ELSEWHERE if once else 0.0)


def _seen(run: Recording) -> list[Message]:
    """Our detections that had time for an answer."""
    seen = [
        one for one in run.messages("/detection") if one.from_course and one.stamp < run.ended.stamp - SOON
    ]
    if len(seen) < 5:
        raise no_data(run, "detections", f"{len(seen)}", run.graph.publishers("/detection"))
    return seen


def _when(heard: Message) -> float:
    return since_start(heard.message.header.stamp)


def _same(seen: Message, found: Message) -> bool:
    return abs(_when(seen) - _when(found)) < 1e-6


def _robot(run: Recording) -> list[tuple[float, float, Flat]]:
    """What ours said of the robot: when it was sent, for when it holds, and where it was."""
    told = []
    for heard in run.messages("/tf"):
        for one in heard.message.transforms if heard.from_course else ():
            shift, turn = one.transform.translation, one.transform.rotation
            when = since_start(one.header.stamp)
            told.append((heard.stamp, when, (shift.x, shift.y, 2 * math.atan2(turn.z, turn.w))))
    return told


def _place(run: Recording, seen: Message) -> tuple[float, float]:
    """Where it really was: ours measure at each moment of a detection."""
    _, _, pose = min(_robot(run), key=lambda row: abs(row[1] - _when(seen)))
    return _seen_from(pose, seen)


def _newest(run: Recording, seen: Message) -> Flat:
    """Where the robot was, by what had come when something was seen."""
    return max(row for row in _robot(run) if row[0] <= seen.stamp)[2]


def _seen_from(pose: Flat, seen: Message) -> tuple[float, float]:
    (x, y, yaw), point = pose, seen.message.point
    cos, sin = math.cos(yaw), math.sin(yaw)
    return x + cos * point.x - sin * point.y, y + sin * point.x + cos * point.y
