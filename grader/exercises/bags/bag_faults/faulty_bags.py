"""Bags of a robot with one fault or none, drawn from a seed."""

from __future__ import annotations

import itertools
import math
import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from grader.companions.recorded_robots import (
    BEGIN,
    DELAY,
    END,
    IMU_MOUNT,
    Mount,
    RobotMessage,
    as_played,
    bag_rows,
    changed,
    explored,
    static_row,
    write_rows,
)
from sim import Process
from sim.evidence import Seconds
from sim.nanoseconds import EPOCH, SECOND

FAULTS = "wheel_radius", "lidar_yaw", "clock_offset", "missing_transform", "two_odometries"
NONE = "none"
BUSY = "busy"  # a healthy robot on a slow network, with odometry at twice the rate
SLOW = 0.25  # s from the robot to the laptop
SCAN, IMU, ODOM, TF = "/scan", "/imu/data", "/odom", "/tf"


@dataclass(frozen=True)
class Case:
    """A bag that is drawn: its fault, how large that is, and where and when it shows.

    amount: of wheel_radius, by which factor odometry is too long; of lidar_yaw, rad to the left; of
    clock_offset, s that stamps are ahead; of missing_transform, s of scans without it; of two_odometries, m
    between both. topics: which show it. begin: s since the robot's start, when it begins. mount: how the
    lidar is mounted by /tf_static.
    """

    kind: str
    seed: int
    amount: float
    topics: tuple[str, ...]
    begin: Seconds
    mount: Mount

    @property
    def name(self) -> str:
        """The name of its fault, which a diagnosis reports."""
        return NONE if self.kind == BUSY else self.kind


def draw_case(kind: str, seed: int) -> Case:
    """The bag of a kind, one of FAULTS, NONE or BUSY, that a seed draws."""
    draw = random.Random(f"bag {kind} {seed}")
    sign, begin = draw.choice((-1.0, 1.0)), BEGIN
    mount = (round(draw.uniform(0.0, 0.05), 3), 0.0, draw.choice((0.0, math.pi / 2, -math.pi / 2, math.pi)))
    amount = 0.0
    topics: tuple[str, ...] = ()
    if kind == "wheel_radius":
        amount, topics = 1.0 + sign * draw.uniform(0.06, 0.14), (ODOM, TF)
    elif kind == "lidar_yaw":
        amount, topics = sign * math.radians(draw.uniform(6.0, 14.0)), (SCAN, "/tf_static")
    elif kind == "clock_offset":
        amount, topics = sign * draw.uniform(0.15, 0.6), (draw.choice((SCAN, IMU)),)
        begin = draw.uniform(12.0, 20.0)
    elif kind == "missing_transform":
        late = draw.random() < 0.5
        amount = draw.uniform(6.0, 20.0) if late else END - BEGIN
        topics = ("/tf_static",)
    elif kind == "two_odometries":
        amount, topics, begin = draw.uniform(0.3, 0.9), (ODOM, TF), draw.uniform(8.0, 20.0)
    return Case(kind, seed, amount, topics, begin, mount)


@lru_cache(maxsize=16)
def rows_of(case: Case) -> tuple[RobotMessage, ...]:
    """The messages of its bag."""
    x, y, yaw = case.mount
    real = (x, y, math.remainder(yaw + case.amount, math.tau)) if case.kind == "lidar_yaw" else case.mount
    recording = explored(case.seed, real)
    rows = bag_rows(recording, case.seed, delay=SLOW if case.kind == BUSY else DELAY)
    change = CHANGES.get(case.kind)
    rows = rows if change is None else change(rows, case)
    return (*_statics(case), *rows)


def _statics(case: Case) -> list[RobotMessage]:
    """The static transforms: in one message, or in two of two publishers."""
    both, lidar = {"imu_link": IMU_MOUNT}, {"base_scan": case.mount}
    if case.kind == "missing_transform":
        late = [static_row(BEGIN + case.amount, lidar)] if case.amount < END - BEGIN else []
        return [static_row(BEGIN, both), *late]
    order = [lidar, both] if random.Random(f"order {case.seed}").random() < 0.5 else [both, lidar]
    return [static_row(BEGIN, frames) for frames in order]


def _scaled(rows: Sequence[RobotMessage], case: Case) -> list[RobotMessage]:
    """Odometry that counts with a wrong radius of both wheels."""
    poses = _Poses(case.amount)
    found = changed(rows, ODOM, poses.scale_odometry)
    return changed(found, TF, poses.scale_transform)


class _Poses:
    """The poses of odometry whose distances and angles are a factor too long, by stamp."""

    def __init__(self, factor: float) -> None:
        self.factor = factor
        self.known: dict[int, tuple[float, float, float]] = {}
        self.before: tuple[float, float, float] | None = None
        self.pose = (0.0, 0.0, 0.0)

    def scale_odometry(self, message: Any) -> None:
        """Change an Odometry message; they come in order."""
        pose, twist = message.pose.pose, message.twist.twist
        here = pose.position.x, pose.position.y, _yaw(pose.orientation)
        if self.before is None:
            self.pose = here
        else:
            x, y, yaw = self.before
            turn = math.remainder(here[2] - yaw, math.tau) * self.factor
            ahead = math.cos(yaw) * (here[0] - x) + math.sin(yaw) * (here[1] - y)
            aside = -math.sin(yaw) * (here[0] - x) + math.cos(yaw) * (here[1] - y)
            ahead, aside = ahead * self.factor, aside * self.factor
            x, y, yaw = self.pose
            moved = (
                math.cos(yaw) * ahead - math.sin(yaw) * aside,
                math.sin(yaw) * ahead + math.cos(yaw) * aside,
            )
            self.pose = x + moved[0], y + moved[1], math.remainder(yaw + turn, math.tau)
        self.before = here
        self.known[_nanoseconds(message.header.stamp)] = self.pose
        _place(pose.position, pose.orientation, self.pose)
        twist.linear.x, twist.angular.z = twist.linear.x * self.factor, twist.angular.z * self.factor

    def scale_transform(self, message: Any) -> None:
        """Change the transform of the same stamp."""
        for each in message.transforms:
            pose = self.known.get(_nanoseconds(each.header.stamp))
            if pose is not None:
                _place(each.transform.translation, each.transform.rotation, pose)


def _yaw(rotation: Any) -> float:
    return 2 * math.atan2(rotation.z, rotation.w)


def _place(position: Any, rotation: Any, pose: tuple[float, float, float]) -> None:
    position.x, position.y = pose[0], pose[1]
    rotation.z, rotation.w = math.sin(pose[2] / 2), math.cos(pose[2] / 2)


def _nanoseconds(stamp: Any) -> int:
    return int(stamp.sec * SECOND + stamp.nanosec)


def _stamp(stamp: Any, nanoseconds: int) -> None:
    stamp.sec, stamp.nanosec = divmod(nanoseconds, SECOND)


def _offset(rows: Sequence[RobotMessage], case: Case) -> list[RobotMessage]:
    """Stamps of one sensor that are wrong from a moment on."""
    ahead, begin = round(case.amount * SECOND), EPOCH + round(case.begin * SECOND)

    def shift(message: Any) -> None:
        measured = _nanoseconds(message.header.stamp)
        if measured >= begin:
            _stamp(message.header.stamp, measured + ahead)

    return changed(rows, case.topics[0], shift)


def _doubled(rows: Sequence[RobotMessage], case: Case) -> list[RobotMessage]:
    """A second program that publishes odometry: it was started later, and believes that it is elsewhere."""
    angle = random.Random(f"where {case.seed}").uniform(-math.pi, math.pi)
    dx, dy = case.amount * math.cos(angle), case.amount * math.sin(angle)
    later, added = 0.025, []
    for row in rows:
        if row.topic in (ODOM, TF) and row.sent >= case.begin and row.received + later < END:
            message = row.message
            stamped = [message] if row.topic == ODOM else message.transforms
            for each in stamped:
                _stamp(each.header.stamp, _nanoseconds(each.header.stamp) + round(later * SECOND))
                place = each.pose.pose.position if row.topic == ODOM else each.transform.translation
                place.x, place.y = place.x + dx, place.y + dy
            moved = row._replace(received=row.received + later, sent=row.sent + later)
            added.append(moved.with_message(message))
    return [*rows, *added]


def _twice_as_often(rows: Sequence[RobotMessage], case: Case) -> list[RobotMessage]:
    """Odometry and its transforms at 40 Hz: between two messages is one more, halfway."""
    found = list(rows)
    for topic in (ODOM, TF):
        mine = [row for row in rows if row.topic == topic]
        for one, other in itertools.pairwise(mine):
            halfway = [(a + b) / 2 for a, b in ((one.received, other.received), (one.sent, other.sent))]
            found.append(one._replace(received=halfway[0], sent=halfway[1], raw=_between(one, other)))
    return found


def _between(one: RobotMessage, other: RobotMessage) -> bytes:
    message, after = one.message, other.message
    pairs = (
        [(message, after)] if one.topic == ODOM else zip(message.transforms, after.transforms, strict=True)
    )
    for a, b in pairs:
        _stamp(a.header.stamp, (_nanoseconds(a.header.stamp) + _nanoseconds(b.header.stamp)) // 2)
        places = [
            (each.pose.pose.position, each.pose.pose.orientation)
            if one.topic == ODOM
            else (each.transform.translation, each.transform.rotation)
            for each in (a, b)
        ]
        (position, rotation), (next_position, next_rotation) = places
        yaw = _yaw(rotation)
        yaw += math.remainder(_yaw(next_rotation) - yaw, math.tau) / 2
        pose = (position.x + next_position.x) / 2, (position.y + next_position.y) / 2, yaw
        _place(position, rotation, pose)
    return one.with_message(message).raw


CHANGES: dict[str, Callable[[Sequence[RobotMessage], Case], list[RobotMessage]]] = {
    "wheel_radius": _scaled, "clock_offset": _offset, "two_odometries": _doubled, BUSY: _twice_as_often
}


def player_of(case: Case) -> Process:
    """The program that plays its bag."""
    return as_played(rows_of(case)).program()


def write_case(case: Case, folder: Path) -> Path:
    """Write its bag into a new folder."""
    return write_rows(rows_of(case), folder)
