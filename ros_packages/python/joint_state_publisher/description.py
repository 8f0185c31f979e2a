"""The joints of a robot that can move, their limits, and which of them repeat another one."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any
from xml.etree import ElementTree

IMMOVABLE = ("fixed", "floating", "planar")


@dataclass
class JointTable:
    """The movable joints of a description.

    names: in its order; free: name to min, max, zero and present values; dependent: name to parent, factor
    and offset.
    """

    names: list[str] = field(default_factory=list)
    free: dict[str, dict[str, Any]] = field(default_factory=dict)
    dependent: dict[str, dict[str, Any]] = field(default_factory=dict)


def read_joints(
    description: str, zeros: Mapping[str, float], *, use_mimic: bool, use_smallest_limits: bool
) -> JointTable:
    """The joints in a URDF. zeros: where joints begin. Raises ValueError with upstream's words."""
    try:
        robot = ElementTree.fromstring(description)
    except ElementTree.ParseError as error:
        raise ValueError(str(error)) from None
    if robot.tag != "robot":
        raise ValueError('URDF must have a "robot" tag')
    table = JointTable()
    for joint in robot.findall("joint"):
        kind, name = joint.get("type", ""), joint.get("name", "")
        if kind in IMMOVABLE:
            continue
        least, most = _limits(joint, name, kind)
        if use_smallest_limits:
            least, most = _softened(joint, least, most)
        table.names.append(name)
        mimic = joint.find("mimic")
        if use_mimic and mimic is not None:
            table.dependent[name] = _dependence(mimic)
            continue
        middle = (least + most) / 2 if least > 0 or most < 0 else 0.0
        zero = zeros.get(name, middle)
        table.free[name] = {"min": least, "max": most, "zero": zero, "continuous": kind == "continuous"}
    return table


def _limits(joint: ElementTree.Element, name: str, kind: str) -> tuple[float, float]:
    if kind == "continuous":
        return -math.pi, math.pi
    limit = joint.find("limit")
    if limit is None:
        raise ValueError(f'Limits must be specified for joint "{name}" of type "{kind}"')
    values = []
    for end in ("lower", "upper"):
        text = limit.get(end)
        if text is None:
            raise ValueError(f'"{end}" limit must be specified for joint "{name}" of type "{kind}"')
        try:
            values.append(float(text))
        except ValueError:
            what = f'"{end}" limit must be a float for joint "{name}" of type "{kind}"'
            raise ValueError(what) from None
    return values[0], values[1]


def _softened(joint: ElementTree.Element, least: float, most: float) -> tuple[float, float]:
    """The limits, or a safety controller's where these are closer."""
    safety = joint.find("safety_controller")
    if safety is None:
        return least, most
    lower, upper = safety.get("soft_lower_limit", least), safety.get("soft_upper_limit", most)
    return max(least, float(lower)), min(most, float(upper))


def _dependence(mimic: ElementTree.Element) -> dict[str, Any]:
    found: dict[str, Any] = {"parent": mimic.get("joint", "")}
    for attribute, key in (("multiplier", "factor"), ("offset", "offset")):
        value = mimic.get(attribute)
        if value is not None:
            found[key] = float(value)
    return found
