"""An exercise on static transforms: say once where a lidar sits, for all who come later."""

from __future__ import annotations

import math
import random
from typing import Any

from geometry_msgs.msg import Pose2D
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

from grader.checks import Missed, hinting, publishes, subscribes
from grader.checks.no_data import no_data
from grader.exercise import Exercise
from grader.exercises.frames.measures import (
    FULL_TURN,
    NEAR,
    PART,
    TF,
    Sent,
    alike,
    flat,
    is_turn,
    named_right,
    sent_frames,
)
from grader.exercises.frames.partners import Flat
from sim.evidence import Recording

STATIC = "/tf_static"
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Mechanic(Node):
    """Has mounted a lidar, and says where (Pose2D on /mounting, kept for latecomers): drawn from the seed."""

    def __init__(self) -> None:
        super().__init__("mechanic")
        turn = random.choice((-1.0, 1.0)) * random.uniform(0.8, 2.4)
        place = Pose2D(x=random.uniform(0.05, 0.2), y=random.uniform(-0.1, 0.1), theta=turn)
        self.publisher = self.create_publisher(Pose2D, "/mounting", LATCHED)
        self.publisher.publish(place)


mount = Exercise("mount", "Where the lidar sits", seconds=3, companions=[Mechanic], seeds=(1, 2))


@mount.check(2)
def sends_static_transforms(run: Recording) -> None:
    """The node hears /mounting (Pose2D), and publishes transforms on /tf_static."""
    with hinting(
        guess="A StaticTransformBroadcaster publishes on /tf_static, a TransformBroadcaster on /tf."
    ):
        subscribes(run, "/mounting", "geometry_msgs/msg/Pose2D")
        publishes(run, STATIC, TF)


@mount.check(5, after=sends_static_transforms)
def puts_it_there(run: Recording) -> Sent:
    """The parent is base_link, the child base_scan, and it is where the mechanic says: x and y."""
    wanted = _truth(run)

    def is_there(_: float, one: Any) -> bool:
        return alike((*flat(one.transform)[:2], 0.0), (*wanted[:2], 0.0))

    sent = named_right(list(sent_frames(run, STATIC)), "base_link", "base_scan", STATIC, is_there)
    if not is_there(*sent[-1]):
        found, hint = flat(sent[-1][1].transform), "translation.x is msg.x, and translation.y is msg.y."
        pairs = zip(wanted[:2], found[:2], strict=True)
        known = [abs(want - saw) <= NEAR < abs(want) / 2 for want, saw in pairs]  # and not by chance, as 0 is
        raise Missed(
            f"x {wanted[0]:.2f} m, y {wanted[1]:.2f} m",
            f"x {found[0]:.2f} m, y {found[1]:.2f} m",
            hint,
            credit=PART if any(known) else 0.0,
            measured=sent,
        )
    return sent


@mount.check(5, after=puts_it_there)
def turns_it(run: Recording, sent: Sent) -> None:
    """It is turned as the mechanic says: a quaternion of length 1, for theta about z."""
    wanted, (_, one) = _truth(run), sent[-1]
    turn = one.transform.rotation
    if not is_turn(one.transform):
        length = math.hypot(turn.x, turn.y, turn.z, turn.w)
        raise Missed(
            "a quaternion of length 1", f"one of length {length:.2f}, which tf2 throws away", FULL_TURN
        )
    if not alike((0.0, 0.0, flat(one.transform)[2]), (0.0, 0.0, wanted[2])):
        hint = "theta is in radians already." if abs(turn.z) < 0.05 and abs(turn.w) > 0.9 else FULL_TURN
        if turn.z == 0.0 and turn.w == 1.0:
            hint = f"z 0 and w 1 is no turn at all. {FULL_TURN}"
        raise Missed(f"yaw {wanted[2]:.2f} rad", f"yaw {flat(one.transform)[2]:.2f} rad", hint)


@mount.check(2, after=puts_it_there)
def says_it_once(run: Recording, _: object) -> None:
    """It is said once, and kept for all who come later."""
    sent = [heard for heard in run.messages(STATIC) if not heard.from_course]
    volatile = [
        end
        for end in run.graph.publishers(STATIC)
        if not end.from_course and end.qos["durability"] == "volatile"
    ]
    if volatile or len(sent) > 1:
        hint = "A StaticTransformBroadcaster keeps it for latecomers: send it once, when /mounting comes."
        raise Missed(
            "one message, kept (transient local)", f"{len(sent)}{', volatile' if volatile else ''}", hint
        )


def _truth(run: Recording) -> Flat:
    told = [heard.message for heard in run.messages("/mounting") if heard.from_course]
    if not told:
        raise no_data(run, "a place on /mounting", "none", run.graph.publishers("/mounting"))
    return told[0].x, told[0].y, told[0].theta
