"""Measures over transforms: which were broadcast, and where they put a frame."""

from collections.abc import Callable
from typing import Any, NamedTuple

from grader.checks.check import Missed
from grader.geometry import Pose2D
from sim.evidence import Recording, Seconds, since_start

TF = "tf2_msgs/msg/TFMessage"
UNIT = 0.01  # how far a quaternion's squared length may be from 1: tf2 throws others away
NEAR = 0.02  # m, rad
PART = 0.2  # of the points, where one thing is wrong and the rest right
FULL_TURN = (
    "A quaternion is not an angle: for a rotation by yaw about z, z = sin(yaw / 2) and w = cos(yaw / 2). "
    "quaternion_from_euler(0, 0, yaw) returns all four numbers."
)


class Broadcast(NamedTuple):
    """A TransformStamped, and when it was sent."""

    stamp: Seconds
    message: Any

    @property
    def frames(self) -> str:
        """Its two frames as tasks write them: "parent → child"."""
        return f"{self.message.header.frame_id} → {self.message.child_frame_id}"

    @property
    def measured(self) -> Seconds:
        """The time of its header."""
        return since_start(self.message.header.stamp)

    @property
    def pose(self) -> Pose2D:
        """Return where the child is in the parent."""
        return Pose2D.from_message(self.message.transform)

    @property
    def is_rotation(self) -> bool:
        """Return whether its quaternion has length 1."""
        turn = self.message.transform.rotation
        squared: float = turn.x**2 + turn.y**2 + turn.z**2 + turn.w**2
        return abs(squared - 1.0) < UNIT


def broadcasts(run: Recording, topic: str, child: str = "", *, from_course: bool = False) -> list[Broadcast]:
    """Return the transforms on a topic that the student's programs sent, or the course's.

    child: only those of this frame.
    """
    rows = [row for row in run.messages(topic) if row.from_course == from_course]
    found = [Broadcast(row.stamp, message) for row in rows for message in row.message.transforms]
    return [sent for sent in found if child in ("", sent.message.child_frame_id)]


def between(
    sent: list[Broadcast], parent: str, child: str, topic: str, is_there: Callable[[Broadcast], bool]
) -> list[Broadcast]:
    """Return the transforms between two frames.

    Raises Missed for none; with a part of the points where the last one `is_there` all the same.
    """
    right = [one for one in sent if one.frames == f"{parent} → {child}"]
    if right:
        return right
    hint = "header.frame_id is the parent, child_frame_id the child. Every letter counts."
    if any(one.frames == f"{child} → {parent}" for one in sent):
        hint = "Parent and child are swapped: header.frame_id is the parent, child_frame_id the child."
    saw = ", ".join(dict.fromkeys(one.frames for one in sent)) or "no transform"
    kept = [one for one in sent[-1:] if is_there(one)]
    credit = PART if kept else 0.0
    raise Missed(f"{parent} → {child} on {topic}", saw, hint, credit=credit, measured=kept)
