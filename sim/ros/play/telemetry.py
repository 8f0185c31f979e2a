"""Numbers shown beside a live picture: the robot's state, and the messages of one selected topic."""

from __future__ import annotations

import math
import numbers
from collections import deque
from collections.abc import Iterator
from typing import Any

from sim.evidence import Message
from sim.ros.play.teleop import teleop_settings
from sim.ros.session import Session

PLOT_PERIOD, MAX_POINTS = 10.0, 400  # s of simulated time, and points of a topic's plot
MAX_LINES, MAX_ITEMS = 40, 6  # shown of a message, and of each list in it
MAX_CURVES = 2
SLIDING = ("slider_joint",)  # moves along a line
SKIPPED_FIELDS = ("header", "covariance", "stamp")


class Telemetry:
    """Follows the messages of a run; each is read once."""

    def __init__(self) -> None:
        self.topic = ""  # the selected one
        self._next = 0
        self._newest: dict[str, Message] = {}
        self._recent: deque[Message] = deque(maxlen=MAX_POINTS)

    def select(self, topic: str) -> None:
        """Show this topic from now on; "" for none."""
        self.topic = topic
        self._recent.clear()

    def update(self, session: Session) -> dict[str, Any]:
        """numbers: pairs of label and text. topic: the selected topic's newest message and plot, or None."""
        messages = session.recording.published
        for message in messages[self._next :]:
            self._newest[message.topic] = message
            if message.topic == self.topic:
                self._recent.append(message)
        self._next = len(messages)
        return {"numbers": list(self._numbers(session)), "topic": self._topic(session)}

    def _numbers(self, session: Session) -> Iterator[tuple[str, str]]:
        world, truth = session.recording.world, session.truth
        settings = teleop_settings(world)
        names = [body.name for body in truth.scene.bodies] if truth is not None else []
        if settings is None or world.driven_body not in names:
            yield from self._joints()
            return
        x, y, yaw = truth.scene.poses[names.index(world.driven_body)]
        yield from (("x", f"{x:.2f} m"), ("y", f"{y:.2f} m"), ("yaw", f"{yaw:.2f} rad"))
        odom = self._message("/odom", "nav_msgs/msg/Odometry")
        if odom is not None:
            yield "v", f"{odom.twist.twist.linear.x:.2f} m/s"
            yield "ω", f"{odom.twist.twist.angular.z:.2f} rad/s"
        yield from self._command(f"/{settings.topic}")
        yield from self._sensors(truth.scene.last_scan, world)
        if world.goal is not None:
            yield "goal", f"{math.dist((x, y), world.goal):.2f} m"
        contacts = session.recording.contacts
        if world.driven_body == names[0] and odom is not None:
            yield "contacts", f"{len(contacts)}, at {contacts[-1].stamp:.1f} s" if contacts else "none"

    def _command(self, topic: str) -> Iterator[tuple[str, str]]:
        command = self._message(topic, "geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped")
        twist = getattr(command, "twist", command)  # of a TwistStamped
        yield "command v", "none yet" if twist is None else f"{twist.linear.x:.2f} m/s"
        yield "command ω", "none yet" if twist is None else f"{twist.angular.z:.2f} rad/s"

    def _joints(self) -> Iterator[tuple[str, str]]:
        """The positions of a machine's joints: radians, or metres of a cart."""
        joints = self._message("/joint_states", "sensor_msgs/msg/JointState")
        if joints is not None:
            for name, position in list(zip(joints.name, joints.position, strict=False))[:MAX_ITEMS]:
                yield name, f"{position:.2f} {'m' if name in SLIDING else 'rad'}"

    def _sensors(self, scan: Any, world: Any) -> Iterator[tuple[str, str]]:
        if scan is not None:
            hits = [(float(reach), ray) for ray, reach in enumerate(scan.ranges) if math.isfinite(reach)]
            reach, ray = min(hits, default=(math.inf, 0))
            angle = math.remainder(ray * world.lidar.angle_increment + world.lidar.yaw, math.tau)
            yield "nearest", f"{reach:.2f} m" if hits else "none"
            yield "at", f"{angle:.2f} rad" if hits else "none"
        bumper = self._message("/bumper", "std_msgs/msg/Bool")
        if bumper is not None:
            yield "bumper", "pressed" if bumper.data else "free"
        battery = self._message("/battery_state", "sensor_msgs/msg/BatteryState")
        if battery is not None:
            yield "battery", f"{100 * battery.percentage:.0f} %"

    def _message(self, topic: str, *kinds: str) -> Any:
        item = self._newest.get(topic)
        return _decoded(item) if item is not None and item.type in kinds else None

    def _topic(self, session: Session) -> dict[str, Any] | None:
        kind = session.recording.topics.get(self.topic)
        if kind is None:
            return None
        item = self._newest.get(self.topic)
        message = _decoded(item) if item is not None else None
        shown = {"name": self.topic, "type": kind, "text": "No message yet.", "stamp": None, "curves": []}
        if message is not None:
            lines = list(_lines(message))
            more = [f"... and {len(lines) - MAX_LINES} more lines"] if len(lines) > MAX_LINES else []
            shown |= {"text": "\n".join(lines[:MAX_LINES] + more), "stamp": item.stamp}
            shown["curves"] = list(self._curves(message, item.stamp))
        return shown

    def _curves(self, message: Any, now: float) -> Iterator[dict[str, Any]]:
        """The curves to plot: the numbers of a long list, or single numbers over time."""
        fields = dict(_single_numbers(message))
        rows = next(_long_lists(message), None)
        if rows is not None:
            name, values = rows
            step = max(1, len(values) // MAX_POINTS)
            points = [[i, float(v)] for i, v in enumerate(values) if i % step == 0 and math.isfinite(v)]
            yield {"name": name, "along": "item", "points": points}
            return
        while self._recent and self._recent[0].stamp < now - PLOT_PERIOD:
            self._recent.popleft()
        seen = [(item.stamp, dict(_single_numbers(_decoded(item)))) for item in self._recent]
        changing = [name for name in fields if len({values.get(name) for _, values in seen}) > 1]
        for name in (changing or list(fields))[:MAX_CURVES]:
            points = [
                [stamp, values[name]] for stamp, values in seen if math.isfinite(values.get(name, math.nan))
            ]
            yield {"name": name, "along": "s", "points": points}


def _decoded(item: Message) -> Any:
    try:
        return item.message
    except Exception:  # invalid bytes
        return None


def _fields(message: Any) -> Iterator[tuple[str, Any]]:
    for name in message.get_fields_and_field_types():
        yield name, getattr(message, name)


def _lines(value: Any, indent: str = "") -> Iterator[str]:
    """A message as `ros2 topic echo` prints it, with long lists abbreviated."""
    for name, part in _fields(value):
        if hasattr(part, "get_fields_and_field_types"):
            yield f"{indent}{name}:"
            yield from _lines(part, indent + "  ")
        elif hasattr(part, "__len__") and not isinstance(part, str | bytes):
            yield from _list(name, list(part), indent)
        else:
            yield f"{indent}{name}: {_format_value(part)}"


def _list(name: str, items: list[Any], indent: str) -> Iterator[str]:
    if items and hasattr(items[0], "get_fields_and_field_types"):
        yield f"{indent}{name}: {len(items)} of these:"
        yield from _lines(items[0], indent + "- ")
        return
    rest = f", ... {len(items)} in all" if len(items) > MAX_ITEMS else ""
    yield f"{indent}{name}: [{', '.join(map(_format_value, items[:MAX_ITEMS]))}{rest}]"


def _format_value(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)[:200]


def _single_numbers(message: Any, before: str = "") -> Iterator[tuple[str, float]]:
    for name, part in _fields(message) if message is not None else ():
        if name in SKIPPED_FIELDS:
            continue
        if hasattr(part, "get_fields_and_field_types"):
            yield from _single_numbers(part, f"{before}{name}.")
        elif isinstance(part, numbers.Real):
            yield f"{before}{name}", float(part)


def _long_lists(message: Any) -> Iterator[tuple[str, list[float]]]:
    for name, part in _fields(message):
        if hasattr(part, "__len__") and not isinstance(part, str | bytes) and len(part) > MAX_ITEMS:
            values = [float(value) for value in part if isinstance(value, numbers.Real)]
            if len(values) == len(part):
                yield name, values
