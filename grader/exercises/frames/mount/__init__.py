"""Broadcast once, as a static transform, where a lidar is mounted."""

import math

from grader.checks import Missed, otherwise, publishes, subscribes
from grader.checks.frames import FULL_TURN, NEAR, PART, TF, Broadcast, between, broadcasts
from grader.exercise import Exercise
from grader.exercises.frames.mount.lidar_mount import Mechanic
from grader.geometry.near import is_near
from grader.responses import from_course, same
from grader.variants import Variants
from sim.evidence import Recording

__all__ = ["Mechanic", "mount"]

STATIC, MOUNTING = "/tf_static", "/mounting"

mount = Exercise("mount", "Where the lidar is mounted", seconds=3, companions=[Mechanic], seeds=(1, 2),
                 variants=Variants(
    {"child": ("base_scan", "laser", "lidar_link")},
    texts=("child `{child}`", "child {child}", '"base_link", "{child}"'),
))


@mount.check(2, guess=f"A StaticTransformBroadcaster publishes on {STATIC}, a TransformBroadcaster on /tf.")
def sends_static_transforms(run: Recording) -> None:
    """The node subscribes to /mounting (Pose2D), and publishes transforms on /tf_static."""
    subscribes(run, MOUNTING, "geometry_msgs/msg/Pose2D")
    publishes(run, STATIC, TF)


@mount.check(5, after=sends_static_transforms)
def puts_it_there(run: Recording) -> list[Broadcast]:
    """The parent is base_link, the child base_scan, and x and y are those that the mechanic published."""
    mounting = from_course(run, MOUNTING)[0].message
    x, y = mounting.x, mounting.y

    def is_right(one: Broadcast) -> bool:
        return math.dist(one.pose[:2], (x, y)) <= NEAR

    sent = between(broadcasts(run, STATIC), "base_link", mount.drawn.child, STATIC, is_right)
    if not is_right(sent[-1]):
        found, hint = sent[-1].pose, "translation.x is msg.x, and translation.y is msg.y."
        # A coordinate that is right, and not by chance as 0 is.
        pairs = (found.x, x), (found.y, y)
        known = [same(is_at, right, NEAR) and not is_near(right, 0.0, 2 * NEAR) for is_at, right in pairs]
        expected, saw = f"x {x:.2f} m, y {y:.2f} m", f"x {found.x:.2f} m, y {found.y:.2f} m"
        raise Missed(expected, saw, hint, credit=PART if any(known) else 0.0, measured=sent)
    return sent


@mount.check(5, after=puts_it_there, hints={
    f"z 0 and w 1 is no rotation at all. {FULL_TURN}": lambda run, turn: turn.z == 0.0 and turn.w == 1.0,
    "theta is already in radians.": lambda run, turn: abs(turn.z) < 0.05 and is_near(abs(turn.w), 1.0, 0.1),
    FULL_TURN: otherwise,
})
def turns_it(run: Recording, sent: list[Broadcast]) -> None:
    """The rotation is the mechanic's theta about z, as a quaternion of length 1."""
    theta, turn = from_course(run, MOUNTING)[0].message.theta, sent[-1].message.transform.rotation
    if not sent[-1].is_rotation:
        length = math.hypot(turn.x, turn.y, turn.z, turn.w)
        saw = f"one of length {length:.2f}, which tf2 discards"
        raise Missed("a quaternion of length 1", saw, FULL_TURN)
    yaw = sent[-1].pose.yaw
    if not is_near(math.remainder(yaw - theta, math.tau), 0.0, NEAR):
        raise Missed(f"yaw {theta:.2f} rad", f"yaw {yaw:.2f} rad", about=(turn,))


@mount.check(2, after=puts_it_there)
def is_latched_and_sent_once(run: Recording) -> None:
    """It is published once, and latched for late subscribers."""
    count = sum(not row.from_course for row in run.messages(STATIC))
    ends = [end for end in run.graph.publishers(STATIC) if not end.from_course]
    volatile = any(end.qos["durability"] == "volatile" for end in ends)
    if volatile or count > 1:
        hint = ("A StaticTransformBroadcaster latches it for late subscribers: send it once, when /mounting "
                "arrives.")
        raise Missed("one message, latched (transient local)", f"{count}{', volatile' * volatile}", hint)
