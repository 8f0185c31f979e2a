"""The links and joints in a URDF, and the pose of each joint's child."""

from __future__ import annotations

import math
from typing import NamedTuple
from xml.etree import ElementTree

from geometry_msgs.msg import Transform
from tf_transformations import (
    quaternion_about_axis,
    quaternion_from_euler,
    quaternion_matrix,
    quaternion_multiply,
)

TURNING = ("revolute", "continuous")
LIMITED = ("revolute", "prismatic")
TYPES = (*TURNING, "prismatic", "fixed", "floating", "planar")
DEFAULT_AXIS = (1.0, 0.0, 0.0)
SMALL = 1e-12

Vector = tuple[float, float, float]


class InvalidDescription(RuntimeError):
    """The text is no URDF that describes a tree of links; the message says why."""


class Mimic(NamedTuple):
    """A joint whose position is that of another one, times `multiplier`, plus `offset`."""

    joint: str
    multiplier: float
    offset: float


class Joint(NamedTuple):
    """A joint between two links."""

    name: str
    type: str
    parent: str
    child: str
    xyz: Vector
    rpy: Vector
    axis: Vector
    mimic: Mimic | None

    @property
    def moves(self) -> bool:
        """Return whether it has a position; upstream takes a planar joint as fixed."""
        return self.type in (*TURNING, "prismatic")

    def transform(self, position: float) -> Transform:
        """The pose of the child in the parent, at a position in radians or meters."""
        rotation = quaternion_from_euler(*self.rpy)
        translation = self.xyz
        if self.type in TURNING:
            rotation = quaternion_multiply(rotation, quaternion_about_axis(position, self.axis))
        elif self.type == "prismatic":
            length = math.hypot(*self.axis)
            along = quaternion_matrix(rotation)[:3, :3] @ self.axis * (position / length)
            translation = tuple(at + by for at, by in zip(self.xyz, along, strict=True))
        return _transform(translation, rotation)


def parse_urdf(text: str) -> dict[str, Joint]:
    """The joints of a robot, by name. Raises InvalidDescription."""
    try:
        robot = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise InvalidDescription(f"The robot description is not XML: {error}") from None
    if robot.tag != "robot":
        raise InvalidDescription(f"The robot description begins with <{robot.tag}>, not with <robot>")
    links = [_name(link, "link") for link in robot.findall("link")]
    joints = [_joint(element) for element in robot.findall("joint")]
    for kind, names in (("link", links), ("joint", [joint.name for joint in joints])):
        repeated = next((name for name in names if names.count(name) > 1), None)
        if repeated is not None:
            raise InvalidDescription(f"{kind} '{repeated}' is not unique.")
    _check_tree(links, joints)
    return {joint.name: joint for joint in joints}


def _check_tree(links: list[str], joints: list[Joint]) -> None:
    parents: dict[str, str] = {}
    for joint in joints:
        for end, link in (("parent", joint.parent), ("child", joint.child)):
            if link not in links:
                raise InvalidDescription(f"{end} link [{link}] of joint [{joint.name}] not found")
        if joint.child in parents:
            raise InvalidDescription(f"link [{joint.child}] is the child of two joints")
        parents[joint.child] = joint.parent
    roots = [link for link in links if link not in parents]
    if not roots:
        raise InvalidDescription("No root link found. The robot xml is not a valid tree.")
    if len(roots) > 1:
        raise InvalidDescription(f"Two root links found: [{roots[0]}] and [{roots[1]}]")
    for link in links:
        seen = {link}
        while link in parents:
            link = parents[link]
            if link in seen:
                raise InvalidDescription(f"link [{link}] is its own ancestor")
            seen.add(link)


def _joint(element: ElementTree.Element) -> Joint:
    name = _name(element, "joint")
    kind = element.get("type", "")
    if kind not in TYPES:
        raise InvalidDescription(f"Joint [{name}] has no known type [{kind}]")
    _check_limit(element, kind, name)
    ends = [_child(element, tag).get("link") for tag in ("parent", "child")]
    for tag, link in zip(("parent", "child"), ends, strict=True):
        if not link:
            raise InvalidDescription(f"no {tag} link name specified for joint [{name}]")
    origin, axis = _child(element, "origin"), _child(element, "axis")
    mimic = element.find("mimic")

    def numbers(of: ElementTree.Element, attribute: str, default: Vector) -> Vector:
        return _vector(of.get(attribute), default, f"{attribute} of joint [{name}]")

    direction = numbers(axis, "xyz", DEFAULT_AXIS)
    if kind in (*TURNING, "prismatic") and math.hypot(*direction) < SMALL:
        raise InvalidDescription(f"The axis of joint [{name}] has no direction")
    return Joint(
        name=name,
        type=kind,
        parent=ends[0] or "",
        child=ends[1] or "",
        xyz=numbers(origin, "xyz", (0.0, 0.0, 0.0)),
        rpy=numbers(origin, "rpy", (0.0, 0.0, 0.0)),
        axis=direction,
        mimic=None if mimic is None else _mimic(mimic, name),
    )


def _check_limit(element: ElementTree.Element, kind: str, name: str) -> None:
    """Raise InvalidDescription where urdfdom refuses a limit: it needs effort and velocity."""
    limit = element.find("limit")
    if limit is None and kind in LIMITED:
        raise InvalidDescription(f"Joint [{name}] is of type {kind.upper()} but it does not specify limits")
    if limit is None:
        return
    for key in ("effort", "velocity"):
        if limit.get(key) is None:
            raise InvalidDescription(f"joint limit: no {key}: the <limit> of joint [{name}] needs it")
    for key in ("lower", "upper", "effort", "velocity"):
        _number(limit.get(key, "0"), f"{key} of joint [{name}]")


def _mimic(element: ElementTree.Element, name: str) -> Mimic:
    joint = element.get("joint")
    if not joint:
        raise InvalidDescription(f"joint mimic: no mimic joint specified for joint [{name}]")
    values = [
        _number(element.get(attribute, default), f"{attribute} of joint [{name}]")
        for attribute, default in (("multiplier", "1"), ("offset", "0"))
    ]
    return Mimic(joint, *values)


def _name(element: ElementTree.Element, kind: str) -> str:
    name = element.get("name")
    if not name:
        raise InvalidDescription(f"unnamed {kind} found")
    return name


def _child(element: ElementTree.Element, tag: str) -> ElementTree.Element:
    found = element.find(tag)
    return ElementTree.Element(tag) if found is None else found


def _vector(text: str | None, default: Vector, what: str) -> Vector:
    if text is None:
        return default
    numbers = [_number(word, what) for word in text.split()]
    if len(numbers) != len(default):
        raise InvalidDescription(f"{what} is '{text}', not three numbers")
    x, y, z = numbers
    return x, y, z


def _number(text: str, what: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise InvalidDescription(f"{what} is '{text}', not a number") from None


def _transform(translation: Vector, rotation: tuple[float, ...]) -> Transform:
    """As a message. Of the two quaternions for a rotation, it has the one that upstream sends."""
    result = Transform()
    point, turn = result.translation, result.rotation
    point.x, point.y, point.z = map(float, translation)
    x, y, z, w = map(float, rotation)
    leading = w if 4 * w * w - 1 > SMALL else max((x, y, z), key=abs)
    sign = math.copysign(1.0, leading)
    turn.x, turn.y, turn.z, turn.w = (sign * part + 0.0 for part in (x, y, z, w))
    return result
