"""Measures a robot's drive in a bag: QoS, the age of scans, and how it stops. It needs ROS 2 only.

On a robot: `ros2 bag record -o my_drive --topics /cmd_vel /odom /scan`, while the robot drives and stops.
"""

import bisect
import itertools
import statistics
from pathlib import Path
from typing import Any, NamedTuple

import yaml
from rclpy.serialization import deserialize_message
from rosbag2_py import ConverterOptions, SequentialReader, StorageOptions
from rosidl_runtime_py.utilities import get_message

TOPICS = ("/cmd_vel", "/odom", "/scan")
STILL = 0.02  # m/s: slower than this is standing
QUIET = 0.5  # s without another command to drive, so that a zero counts as a stop
RELIABILITIES = {1: "reliable", 2: "best_effort"}


class Odometry(NamedTuple):
    """Where the robot believed it was (m), its speed (m/s), and when that was recorded (s)."""

    stamp: float
    x: float
    y: float
    speed: float


class Drive(NamedTuple):
    """What a bag has: times are those at which messages were recorded, in seconds since the first one."""

    commands: list[tuple[float, float]]  # time, m/s
    odometry: list[Odometry]
    scans: list[float]  # times
    ages: list[float]  # s: how old each scan was when it was recorded, by its stamp
    reliability: dict[str, str]  # of the publishers of each topic

    @property
    def scan_rate(self) -> float:
        """Scans in a second."""
        return (len(self.scans) - 1) / (self.scans[-1] - self.scans[0]) if len(self.scans) > 1 else 0.0

    @property
    def scan_age(self) -> float:
        """The median age of a scan, s; 0 without scans."""
        return statistics.median(self.ages) if self.ages else 0.0


class Stop(NamedTuple):
    """One stop: from the first command of 0 until the robot stood."""

    begin: float  # s: when the command was recorded
    speed: float  # m/s, just before
    reaction: float  # s: until the robot began to slow down
    braking: float  # m/s²
    distance: float  # m: all that it drove after the command

    @property
    def predicted(self) -> float:
        """The distance by the formula of lesson 5."""
        return self.speed * self.reaction + self.speed**2 / (2 * self.braking)


def read(bag: str | Path) -> Drive:
    """Read a bag, a folder or an MCAP file."""
    reader = SequentialReader()
    reader.open(StorageOptions(uri=str(bag), storage_id="mcap"), ConverterOptions("", ""))
    topics = {topic.name: topic for topic in reader.get_all_topics_and_types()}
    drive, first = Drive([], [], [], [], _reliabilities(Path(bag))), None
    while reader.has_next():
        topic, raw, nanoseconds = reader.read_next()
        first = nanoseconds if first is None else first
        if topic in TOPICS:
            message = deserialize_message(raw, get_message(topics[topic].type))
            _add(drive, topic, message, (nanoseconds - first) / 1e9, nanoseconds / 1e9)
    return drive


def _add(drive: Drive, topic: str, message: Any, now: float, clock: float) -> None:
    if topic == "/cmd_vel":  # a Twist, or a TwistStamped
        drive.commands.append((now, getattr(message, "twist", message).linear.x))
    elif topic == "/odom":
        place = message.pose.pose.position
        drive.odometry.append(Odometry(now, place.x, place.y, message.twist.twist.linear.x))
    else:
        stamp = message.header.stamp
        drive.scans.append(now)
        drive.ages.append(clock - stamp.sec - stamp.nanosec / 1e9)


def _reliabilities(bag: Path) -> dict[str, str]:
    """The reliability that the first publisher of each topic offered, as the recorder stored it."""
    found: dict[str, str] = {}
    if (bag / "metadata.yaml").exists():
        about = yaml.safe_load((bag / "metadata.yaml").read_text(encoding="utf-8"))
        for row in about["rosbag2_bagfile_information"]["topics_with_message_count"]:
            topic = row["topic_metadata"]
            found[topic["name"]] = _first(topic.get("offered_qos_profiles"))
    if "unknown" in (found or {"": "unknown"}).values():  # some recorders store it with the messages only
        from mcap.reader import make_reader

        for file in sorted(bag.glob("*.mcap")) if bag.is_dir() else [bag]:
            with file.open("rb") as stream:
                for channel in make_reader(stream).get_summary().channels.values():
                    found[channel.topic] = _first(channel.metadata.get("offered_qos_profiles"))
    return found


def _first(profiles: Any) -> str:
    """The reliability of the first of these profiles, which may be a text in YAML."""
    profiles = yaml.safe_load(profiles) if isinstance(profiles, str) else profiles
    value = profiles[0]["reliability"] if profiles else 0
    return RELIABILITIES.get(value, "unknown") if isinstance(value, int) else value


def stops(drive: Drive) -> list[Stop]:
    """Every stop in a drive: a command to drive, then a command of 0 and no other until it stands.

    One that comes down in steps is none: there the program brakes, and not the robot.
    """
    found = []
    for (_, before), (begin, speed) in itertools.pairwise(drive.commands):
        around = [(at - begin, command) for at, command in drive.commands if abs(at - begin) < 1.0]
        again = any(command for lag, command in around if 0 <= lag < QUIET)
        slower = abs(before) < 0.9 * max(abs(command) for _, command in around)
        if before and not speed and not again and not slower:
            found += _stop(drive.odometry, begin)
    return found


def _stop(odometry: list[Odometry], begin: float) -> list[Stop]:
    """The stop that begins with a command at this time; none if the robot did not drive, or never stood."""
    start = bisect.bisect_left(odometry, begin, key=lambda row: row.stamp)
    just_before = [abs(row.speed) for row in odometry[max(0, start - 5) : start]]
    speed = statistics.median(just_before) if just_before else 0.0
    standing = next((i for i in range(start, len(odometry)) if abs(odometry[i].speed) < STILL), None)
    if speed < 2 * STILL or standing is None:
        return []
    rows = odometry[max(0, start - 1) : standing + 1]
    slowing = [row for row in rows if 0.15 * speed < abs(row.speed) < 0.9 * speed]
    if len(slowing) < 2:  # it stops within one or two measurements
        last = max(i for i, row in enumerate(rows) if abs(row.speed) >= 0.9 * speed)
        slowing = rows[last : last + 2]
    slope, offset = _line([(row.stamp, abs(row.speed)) for row in slowing])
    reaction = (speed - offset) / slope - begin
    path = odometry[max(0, start - 1) : standing + 2]
    part = (begin - path[0].stamp) / max(path[1].stamp - path[0].stamp, 1e-9)
    x, y = (path[0][axis] + part * (path[1][axis] - path[0][axis]) for axis in (1, 2))
    distance = ((path[-1].x - x) ** 2 + (path[-1].y - y) ** 2) ** 0.5
    return [Stop(begin, speed, max(0.0, reaction), -slope, distance)]


def _line(points: list[tuple[float, float]]) -> tuple[float, float]:
    """Slope and offset of the line that fits best."""
    slope, offset = statistics.linear_regression(*zip(*points, strict=True))
    return slope, offset
