"""A description in URDF, of which robot_state_publisher makes the frames of a camera."""

import math
import operator
from collections.abc import Sequence
from typing import Any
from xml.etree import ElementTree

from tf_transformations import quaternion_from_euler

from grader.checks import Missed, otherwise, publishes
from grader.checks.frames import Broadcast, broadcasts
from grader.exercise import Exercise
from grader.exercises.drawing.describe.pan_tilt_driver import LIMITS, pan_tilt_driver
from grader.geometry.near import is_near
from grader.responses import from_course, same
from grader.variants import Variants
from sim.evidence import Recording, since_start

__all__ = ["describe", "pan_tilt_driver"]

MOVING = {  # joint: its parent, its child, where it is on the parent (m), and its axis
    "pan_joint": ("base_link", "pan_link", (0.0, 0.0, 0.1), (0.0, 0.0, 1.0)),
    "tilt_joint": ("pan_link", "tilt_link", None, (0.0, 1.0, 0.0)),  # the place is drawn
}
LINKS = "base_link", "pan_link", "tilt_link", "camera"
CAMERA, ROLL = LINKS[2:], 3.1416
OF_A_LIMIT = "lower", "upper", "effort", "velocity"
STRENGTH = 2.0, 3.0  # N m, rad/s
SHOWN = "from {:g} to {:g} rad, effort {:g}, velocity {:g}"
NEAR = 0.001  # m; and of a quaternion's numbers
LEAST = 5  # transforms of each joint
PART = 0.25  # of the points, where a joint turns, but about another axis or at another place

describe = Exercise("describe", "A description of your own", seconds=5, companions=pan_tilt_driver,
                    seeds=(1, 2), variants=Variants(
    {"x": (0.05, 0.04, 0.07), "z": (0.06, 0.08, 0.05), "x_cm": (5, 4, 7), "z_cm": (6, 8, 5)},  # m, cm
    {"lower": (-0.5, -0.6, -0.55), "upper": (1.0, 1.1, 1.2)},  # rad
    {"ahead": (0.04, 0.03, 0.05), "above": (0.02, 0.03, 0.04)},  # m
    texts=('"{x} 0 {z}"', "is {x_cm} cm forward and {z_cm} cm up", "{x} m in front of", "{z} m above it",
           "limits are {lower} and {upper} rad", 'lower="{lower}" upper="{upper}"',
           "{ahead} m in front and {above} m above", '"{ahead} 0 {above}"'),
))


@describe.check(1, guess="Return the text of two links and two joints, and leave the rest as it is.")
def publishes_a_description(run: Recording) -> ElementTree.Element:
    """The description is on /robot_description, and has the four links."""
    text = publishes(run, "/robot_description", "std_msgs/msg/String")[-1].message.data
    try:
        robot = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise Missed("a description in XML", f"{error}") from None
    links = [link.get("name") for link in robot.iterfind("link")]
    if not set(LINKS) <= set(links):
        saw = ", ".join(map(str, links)) or "no link"
        raise Missed(f"the links {', '.join(LINKS)}", saw, credit=0.5, measured=robot)
    return robot


@describe.check(2, after=publishes_a_description, hints={
    "A joint is at its `origin` on the parent, in meters: xyz=\"0.05 0 0.06\" is 5 cm forward and 6 cm up.":
        lambda run, sent, place, turn: not same(_numbers(sent)[0], place, NEAR),
    "The tilt joint turns about y, the axis to the left: <axis xyz=\"0 1 0\"/>. Without an axis it is x.":
        otherwise,
}, guess="Names count: joints are called as on /joint_states, and have the parents and children of the task.")
def moves_with_its_joints(run: Recording, robot: ElementTree.Element) -> ElementTree.Element:
    """pan_link and tilt_link are on /tf: where the joints' positions put them."""
    states = {since_start(row.message.header.stamp): row.message for row in from_course(run, "/joint_states")}
    known = {stamp: dict(zip(row.name, row.position, strict=True)) for stamp, row in states.items()}
    drawn = describe.drawn
    for name, (parent, child, fixed, axis) in MOVING.items():
        place = fixed or (drawn.x, 0.0, drawn.z)
        sent = [one for one in broadcasts(run, "/tf", child) if one.measured in known]
        if len(sent) < LEAST:
            raise Missed(f"{parent} → {child} on /tf for each position of {name}", _frames(run, "/tf"))
        positions = [known[one.measured][name] for one in sent]
        turned = all(map(_is_turned, sent, positions))
        part: dict[str, Any] = {"credit": PART, "measured": robot} if turned else {}
        for one, position in zip(sent, positions, strict=True):
            if one.message.header.frame_id != parent:
                raise Missed(f"{parent} → {child} on /tf", one.frames, **part)
            turn = quaternion_from_euler(*(position * number for number in axis))
            _require(one, place, turn, f"with {name} at {position:.2f} rad", **part)
    return robot


@describe.check(1, after=moves_with_its_joints, hints={
    "A camera that hangs upside down is rolled by half a turn, in radians: rpy=\"3.1416 0 0\".":
        lambda run, sent, place, turn: same(_numbers(sent)[0], place, NEAR),
    "The fixed joint has an origin, too: xyz=\"0.04 0 0.02\" on tilt_link, in meters.": otherwise,
}, guess="A joint of type fixed connects tilt_link, its parent, to camera, its child.")
def mounts_the_camera(run: Recording, robot: ElementTree.Element) -> None:
    """The camera is fixed on tilt_link: its transform is on /tf_static."""
    sent = broadcasts(run, "/tf_static", CAMERA[1])
    if not sent or sent[-1].message.header.frame_id != CAMERA[0]:
        raise Missed(f"{' → '.join(CAMERA)} on /tf_static", _frames(run, "/tf_static"))
    place = (describe.drawn.ahead, 0.0, describe.drawn.above)
    _require(sent[-1], place, quaternion_from_euler(ROLL, 0.0, 0.0), "upside down")


@describe.check(2, after=moves_with_its_joints)
def has_limits(run: Recording, robot: ElementTree.Element) -> None:
    """Both joints that move have the limits of the task, in radians, with their effort and velocity."""
    limits = {joint.get("name"): joint.find("limit") for joint in robot.iterfind("joint[@type='revolute']")}
    drawn = describe.drawn
    for name, ends in {**LIMITS, "tilt_joint": (drawn.lower, drawn.upper)}.items():
        limit = limits.get(name)
        found = None if limit is None else [_number(limit.get(key, "0")) for key in OF_A_LIMIT]
        if found is None or not same(found, [*ends, *STRENGTH], NEAR):
            saw = "no limit" if found is None else SHOWN.format(*found)
            hint = ('A revolute joint has <limit lower="..." upper="..." effort="..." velocity="..."/>, in '
                    "radians. A continuous joint turns without end.")
            raise Missed(f"{name} {SHOWN.format(*ends, *STRENGTH)}", saw, hint)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


def _is_turned(sent: Broadcast, position: float) -> bool:
    """Return whether it turns by this angle (rad), about any axis."""
    return bool(abs(abs(sent.message.transform.rotation.w) - abs(math.cos(position / 2))) < NEAR)


def _require(sent: Broadcast, place: Sequence[float], turn: Sequence[float], when: str, **part: Any) -> None:
    """Raises Missed where a transform is another one. part: further arguments of Missed."""
    there, rotation = _numbers(sent)
    same_turn = is_near(abs(sum(map(operator.mul, rotation, map(float, turn)))), 1.0, NEAR**2)
    if not (same_turn and same(there, place, NEAR)):
        expected = f"{sent.message.child_frame_id} at {_text(place)} m, turned by {_text(turn)}, {when}"
        saw = f"at {_text(there)} m, turned by {_text(rotation)}"
        raise Missed(expected, saw, about=(sent, place, turn), **part)


def _numbers(sent: Broadcast) -> tuple[list[float], list[float]]:
    """A transform's translation, and its quaternion."""
    place, turn = sent.message.transform.translation, sent.message.transform.rotation
    return [place.x, place.y, place.z], [turn.x, turn.y, turn.z, turn.w]


def _frames(run: Recording, topic: str) -> str:
    """The transforms that are on a topic, as text."""
    return ", ".join(dict.fromkeys(one.frames for one in broadcasts(run, topic))) or "no transform"


def _text(numbers: Sequence[Any]) -> str:
    return " ".join(f"{round(number, 3) + 0.0:g}" for number in numbers)
