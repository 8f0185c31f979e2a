"""What the checks of 09_frames measure of frames."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

from grader.checks import Missed
from grader.exercises.frames.partners import Flat
from sim.evidence import Recording

Sent = list[tuple[float, Any]]  # transforms, each with the moment when it was sent (s)

TF = "tf2_msgs/msg/TFMessage"
UNIT = 0.01  # how far a quaternion's squared length may be from 1: tf2 throws others away
NEAR = 0.02  # m, rad
PART = 0.2  # of the points, where one thing is wrong and the rest right
FULL_TURN = (
    "A quaternion is not an angle: for a turn by yaw about z, z = sin(yaw / 2) and w = cos(yaw / 2). "
    "quaternion_from_euler(0, 0, yaw) gives all four numbers."
)


def sent_frames(run: Recording, topic: str) -> Iterator[tuple[float, Any]]:
    """Each transform on a topic that is the student's, with the moment when it was sent."""
    for heard in run.messages(topic):
        if not heard.from_course:
            yield from ((heard.stamp, one) for one in heard.message.transforms)


def names(one: Any) -> str:
    """The two frames of a transform, as the task writes them."""
    return f"{one.header.frame_id} → {one.child_frame_id}"


def flat(motion: Any) -> Flat:
    """x, y and yaw of a transform."""
    turn = motion.rotation
    yaw = 2 * math.atan2(turn.z, turn.w)
    return motion.translation.x, motion.translation.y, math.remainder(yaw, math.tau)


def is_turn(motion: Any) -> bool:
    """Whether the rotation is one: a quaternion of length 1."""
    turn = motion.rotation
    return abs(turn.x**2 + turn.y**2 + turn.z**2 + turn.w**2 - 1.0) < UNIT


def place(pose: Flat) -> str:
    """x, y and yaw in words."""
    return f"x {pose[0]:.2f} m, y {pose[1]:.2f} m, yaw {pose[2]:.2f} rad"


def alike(one: Flat, other: Flat) -> bool:
    """Whether two places are the same, within 2 cm and 0.02 rad; NaN is none."""
    turned = math.remainder(one[2] - other[2], math.tau)
    return math.dist(one[:2], other[:2]) <= NEAR and abs(turned) <= NEAR


def named_right(
    found: Sent, parent: str, child: str, topic: str, is_there: Callable[[float, Any], bool]
) -> Sent:
    """The transforms between these two frames.

    Raises Missed where there are none; with a part of the points where the last one `is_there` all the same.
    """
    right = [(stamp, one) for stamp, one in found if names(one) == f"{parent} → {child}"]
    if right:
        return right
    if any(names(one) == f"{child} → {parent}" for _, one in found):
        hint = "Parent and child are swapped: header.frame_id is the parent, child_frame_id the child."
    else:
        hint = "header.frame_id is the parent, child_frame_id the child. Each letter counts."
    told = ", ".join(dict.fromkeys(names(one) for _, one in found)) or "no transform"
    kept = found[-1:] if found and is_there(*found[-1]) else []
    credit = PART if kept else 0.0
    raise Missed(f"{parent} → {child} on {topic}", told, hint, credit=credit, measured=kept)
