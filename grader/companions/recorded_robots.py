"""Bags of a robot that explores a room: what it sent, as a laptop recorded it over radio."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import yaml
from geometry_msgs.msg import TransformStamped
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from grader.companions.blind_drivers import BlindDriver
from grader.companions.drivers import Speeds
from sim.evidence import Recording, Seconds
from sim.nanoseconds import EPOCH, SECOND
from sim.ros.bags.bag_files import BagWriter
from sim.ros.bags.played import BagMessage, PlayedBag
from sim.ros.bags.qos import recorded_qos
from sim.ros.messages.codec import encode
from sim.ros.messages.decoder import decode
from sim.ros.run import run
from sim.world import World
from sim.world.imu import ImuModel
from sim.world.lidar import LidarModel

REST, BEGIN, END = 4.0, 1.0, 32.0  # s: until it drives off; when the recording begins and ends
NEAR, CLEAR = 0.55, 0.9  # m ahead: where it begins to turn, and where it drives on
TOPICS = ("/cmd_vel", "/imu/data", "/odom", "/scan", "/tf")
STATIC, TF_TYPE = "/tf_static", "tf2_msgs/msg/TFMessage"
IMU_MOUNT = (0.0, 0.0, 0.0)
BEST_EFFORT = {"reliability": "best_effort", "durability": "volatile", "depth": 5}
LATCHED = {"reliability": "reliable", "durability": "transient_local", "depth": 1}
QOS = {"/scan": BEST_EFFORT, "/imu/data": BEST_EFFORT, STATIC: LATCHED}
DELAY, JITTER = 0.012, 0.006  # s from the robot to the laptop
Mount = tuple[float, float, float]  # x, y (m) and yaw (rad) in base_link


class RobotMessage(NamedTuple):
    """A message of a bag. received, sent: s since the robot's start, by the clocks of laptop and robot."""

    received: Seconds
    sent: Seconds
    topic: str
    type: str
    raw: bytes

    @property
    def message(self) -> Any:
        """The message; a fresh copy for each reader."""
        return decode(self.type, self.raw)

    def with_message(self, message: Any) -> RobotMessage:
        """Return it with another content."""
        return self._replace(raw=encode(message))


class Explorer(BlindDriver):
    """Stands at first, so that a gyro's bias can be measured; then drives in curves, and turns at walls.

    yaw: by which the lidar is turned.
    """

    def __init__(self, yaw: float) -> None:
        super().__init__("explorer")
        self.yaw, self.ahead, self.turn = yaw, math.inf, 0.0
        self.side, self.is_ahead = random.choice((-1.0, 1.0)), None
        self.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)

    def on_scan(self, scan: LaserScan) -> None:
        """Note what is ahead, within 40 degrees."""
        if self.is_ahead is None:
            angles = scan.angle_min + scan.angle_increment * np.arange(len(scan.ranges)) + self.yaw
            self.is_ahead = np.cos(angles) > math.cos(math.radians(40.0))
        self.ahead = float(np.nanmin(np.asarray(scan.ranges)[self.is_ahead]))

    def command(self, now: Seconds) -> Speeds:
        """Turn until it is clear ahead, always the same way round; otherwise drive in a curve."""
        if now < REST:
            return 0.0, 0.0
        if self.ahead < (CLEAR if self.turn else NEAR):
            self.turn = self.turn or self.side * random.uniform(0.7, 1.0)
            return 0.0, self.turn
        self.turn = 0.0
        return 0.35, 0.25 * math.sin(0.9 * now)


@lru_cache(maxsize=32)
def explored(seed: int, lidar: Mount) -> Recording:
    """The run of a robot in a room of its own. lidar: how the lidar is really mounted."""
    x, y, yaw = lidar
    world = replace(
        World.generate("room", seed=seed, boxes=3, circles=1),
        lidar=LidarModel(rays=180, range_max=8.0, noise=0.01, x=x, y=y, yaw=yaw),
        imu=ImuModel(rate=50.0),
    )
    driver = lambda: Explorer(yaw)  # noqa: E731 - a program's name is its function's
    return run(driver, world=world, seconds=END + 0.5, seed=seed, quiet=True)


def bag_rows(recording: Recording, seed: int, *, delay: Seconds = DELAY) -> list[RobotMessage]:
    """The robot's messages as they were received, without static transforms."""
    chance = random.Random(f"radio {seed}")
    rows, newest = [], dict.fromkeys(TOPICS, 0.0)
    for sent in recording.messages():
        if sent.topic in TOPICS:
            received = max(newest[sent.topic], sent.stamp + delay + chance.uniform(-JITTER, JITTER))
            newest[sent.topic] = received  # a topic's messages arrive in their order
            rows.append(RobotMessage(received, sent.stamp, sent.topic, sent.type, sent.raw))
    return [row for row in rows if BEGIN <= row.received < END]


def silenced(
    rows: Iterable[RobotMessage], topic: str, silent: tuple[Seconds, Seconds], hiccup: tuple[Seconds, Seconds]
) -> list[RobotMessage]:
    """The rows of a bag with a silent sensor and, at another time, a silent radio.

    silent: when the sensor of `topic` measures nothing (s). hiccup: when the radio delivers nothing of it:
    the messages wait, and arrive all at once.
    """
    found, newest = [], 0.0
    for row in rows:
        if row.topic == topic and silent[0] <= row.sent < silent[1]:
            continue
        if row.topic == topic:
            waited = hiccup[0] <= row.received < hiccup[1]
            received = hiccup[1] + 0.1 * (row.received - hiccup[0]) if waited else row.received
            newest = max(received, newest + 0.004)  # they arrive in their order, and one by one
            row = row._replace(received=newest)
        found.append(row)
    return found


def static_row(received: Seconds, frames: dict[str, Mount]) -> RobotMessage:
    """A message on /tf_static, which was sent as the robot started: where frames are in base_link."""
    transforms = [_transform(name, *mount) for name, mount in frames.items()]
    return RobotMessage(received, 0.0, STATIC, TF_TYPE, encode(TFMessage(transforms=transforms)))


def _transform(child: str, x: float, y: float, yaw: float) -> TransformStamped:
    sent = TransformStamped(child_frame_id=child)
    sent.header.frame_id, sent.header.stamp.sec = "base_link", EPOCH // SECOND
    move = sent.transform
    move.translation.x, move.translation.y = x, y
    move.rotation.z, move.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return sent


def changed(rows: Iterable[RobotMessage], topic: str, change: Callable[[Any], Any]) -> list[RobotMessage]:
    """The rows, where `change` has changed each message of a topic in place."""
    found = []
    for row in rows:
        if row.topic == topic:
            message = row.message
            change(message)
            found.append(row.with_message(message))
        else:
            found.append(row)
    return found


def as_played(rows: Sequence[RobotMessage], qos: dict[str, Any] | None = None) -> PlayedBag:
    """The bag of these rows, to be played. qos: of topics, where it isn't the usual one."""
    stored = {topic: yaml.safe_dump([recorded_qos(used)]) for topic, used in _qos(rows, qos).items()}
    ordered = sorted(rows, key=lambda row: row.received)
    messages = [BagMessage(_moment(row.received), row.topic, row.type, row.raw) for row in ordered]
    return PlayedBag(messages, stored, {})


def write_rows(rows: Sequence[RobotMessage], folder: Path, qos: dict[str, Any] | None = None) -> Path:
    """Write the bag of these rows into a new folder, in the format of rosbag2. Raises BagError."""
    used = _qos(rows, qos)
    with BagWriter(folder) as writer:
        for row in sorted(rows, key=lambda row: row.received):
            times = _moment(row.received), _moment(row.sent)
            writer.write(row.topic, row.type, row.raw, times, used[row.topic])
    return folder


def _qos(rows: Sequence[RobotMessage], qos: dict[str, Any] | None) -> dict[str, Any]:
    return {row.topic: {} for row in rows} | {k: v for k, v in (QOS | (qos or {})).items()}


def _moment(stamp: Seconds) -> int:
    return EPOCH + round(stamp * SECOND)
