"""Names and units of numeric fields in plots, and which messages are commands."""

from __future__ import annotations

from typing import Any

from sim.evidence.readings import SLIDING
from sim.view.units import unit_of

_NAMES = ("name", "joint_names")  # the fields that have the names of the items of other fields
_JOINT_UNITS = {"position": ("rad", "m"), "velocity": ("rad/s", "m/s"), "effort": ("N m", "N")}
_COMMANDS = ("Twist", "TwistStamped", "JointTrajectory")
_COMMAND_TOPICS = ("cmd", "command")


def field_label(message: Any, field: str) -> str:
    """The name of a field; of an item such as position.1 that of its joint: "elbow_joint position"."""
    joint = _joint(message, field)
    return f"{joint} {field.split('.')[-2]}" if joint else field


def panel_unit(message: Any, field: str) -> str:
    """The unit of a field; of a joint that of an angle, or of a length if it slides. "" if it is unknown."""
    joint = _joint(message, field)
    units = _JOINT_UNITS.get(field.split(".")[-2]) if joint else None
    return unit_of(message, field) if units is None else units[joint in SLIDING]


def is_command(topic: str, kind: str) -> bool:
    """Return whether a topic has commands: each holds until the next one."""
    return kind.split("/")[-1] in _COMMANDS or any(word in topic for word in _COMMAND_TOPICS)


def _joint(message: Any, field: str) -> str:
    """The name of the joint whose item of a list this field is, or ""."""
    *_, item = field.split(".")
    names = next((list(getattr(message, name)) for name in _NAMES if hasattr(message, name)), [])
    return names[int(item)] if item.isdecimal() and "." in field and int(item) < len(names) else ""
