"""An exercise on moving frames: broadcast what odometry says."""

from __future__ import annotations

import math
import random

from builtin_interfaces.msg import Time
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from rclpy.duration import Duration
from rclpy.node import Node

from grader.checks import Missed, hinting, publishes, subscribes
from grader.checks.fields import stamp_words
from grader.checks.no_data import no_data
from grader.exercise import Exercise
from grader.exercises.frames.measures import (
    FULL_TURN,
    NEAR,
    PART,
    TF,
    alike,
    flat,
    is_turn,
    named_right,
    place,
    sent_frames,
)
from grader.exercises.frames.partners import Flat
from sim.evidence import Recording, since_start

ODOMETRY = "nav_msgs/msg/Odometry"
PERIOD = 0.1  # s
SOON = 0.05  # s
EARLY = 0.3  # s; until then, a place may be right by accident
OFTEN = 0.3  # of the odometries


class Wheels(Node):
    """The odometry of another robot, on /wheels/odom: it drives a curve, and speaks a little late.

    The run's seed decides on the curve, and how old each measurement is.
    """

    def __init__(self) -> None:
        super().__init__("wheels")
        self.publisher = self.create_publisher(Odometry, "/wheels/odom", 10)
        self.x = self.y = 0.0
        self.yaw = random.uniform(-3.0, 3.0)
        self.turn = random.choice((-1.0, 1.0)) * random.uniform(0.3, 0.8)
        self.create_timer(PERIOD, self.drive)

    def drive(self) -> None:
        """Go on for a period, and tell."""
        self.yaw = math.remainder(self.yaw + self.turn * PERIOD, math.tau)
        self.x += 0.4 * PERIOD * math.cos(self.yaw)
        self.y += 0.4 * PERIOD * math.sin(self.yaw)
        odom = Odometry(child_frame_id="base_link")
        age = Duration(seconds=random.uniform(0.01, 0.08))
        odom.header.frame_id, odom.header.stamp = "odom", (self.get_clock().now() - age).to_msg()
        odom.pose.pose.position.x, odom.pose.pose.position.y = self.x, self.y
        odom.pose.pose.orientation.z, odom.pose.pose.orientation.w = (
            math.sin(self.yaw / 2),
            math.cos(self.yaw / 2),
        )
        odom.twist.twist.linear.x, odom.twist.twist.angular.z = 0.4, self.turn
        self.publisher.publish(odom)


odometry = Exercise("odometry", "From odometry to a frame", seconds=4, companions=[Wheels], seeds=(1, 2))


@odometry.check(2)
def hears_and_sends(run: Recording) -> None:
    """The node hears /wheels/odom, and publishes transforms on /tf."""
    with hinting(guess="sendTransform of a TransformBroadcaster publishes on /tf: call it in the callback."):
        subscribes(run, "/wheels/odom", ODOMETRY)
        publishes(run, "/tf", TF)


@odometry.check(5, after=hears_and_sends)
def puts_it_there(run: Recording) -> None:
    """The parent is odom, the child base_link, and it is where the odometry has it, turned as it is."""
    told = _told(run)
    sent_ones = list(sent_frames(run, "/tf"))
    faults = [(sent, fault) for sent, one in sent_ones if (fault := _fault(told, sent, one))]
    named_right(sent_ones, "odom", "base_link", "/tf", lambda *_: not faults)
    if faults:
        late = [fault.credit for stamp, fault in faults if stamp > EARLY]
        worst = faults[0][1]
        raise Missed(worst.expected, worst.saw, worst.hint, credit=min(late, default=0.0))
    count = len(sent_ones)
    if count < OFTEN * len(told):
        hint = "The robot drives on: send in the callback of /wheels/odom, each time it is called."
        raise Missed(f"a transform for each of {len(told)} odometries", f"{count}", hint)


def _fault(told: list[tuple[float, Odometry]], sent: float, one: TransformStamped) -> Missed | None:
    """What is wrong with a transform; with a part of the points where its place or its turn is right."""
    before = [_pose(message) for stamp, message in told if stamp <= sent + 1e-6]
    if not before:
        return None
    wanted, found = before[-1], flat(one.transform)
    if is_turn(one.transform) and alike(found, wanted):
        return None
    hint = "Parts of rotation are those of pose.pose.orientation, all four. " + FULL_TURN
    placed = math.dist(found[:2], wanted[:2]) <= NEAR
    if not placed:
        hint = "translation is the position, pose.pose.position: x and y of the same message."
    turned = is_turn(one.transform) and abs(math.remainder(found[2] - wanted[2], math.tau)) <= NEAR
    late = any(alike(found, pose) for pose in before[-3:])
    if late:
        hint = "That is where it was before. Send in the callback of /wheels/odom, and not from a timer."
    credit = PART if placed or turned or late else 0.0
    return Missed(f"{place(wanted)} at {sent:.3g} s", place(found), hint, credit=credit)


def _pose(odom: Odometry) -> Flat:
    turn, position = odom.pose.pose.orientation, odom.pose.pose.position
    return position.x, position.y, math.remainder(2 * math.atan2(turn.z, turn.w), math.tau)


@odometry.check(3, after=puts_it_there)
def one_for_each(run: Recording) -> None:
    """Each odometry gives one transform, at once."""
    sent = [stamp for stamp, _ in sent_frames(run, "/tf")]
    for stamp, _ in _told(run)[:-1]:  # the answer to the last may not have come
        count = sum(stamp <= one < stamp + SOON for one in sent)
        if count != 1:
            hint = (
                "Send in the callback of /wheels/odom: one transform for each message, and none from a timer."
            )
            raise Missed(
                f"one transform for the odometry at {stamp:.3g} s, within {SOON:g} s", f"{count}", hint
            )


@odometry.check(4, after=puts_it_there)
def stamps_it(run: Recording) -> None:
    """The transform has the odometry's stamp: when it was measured, and not when it was sent."""
    stamps = [since_start(message.header.stamp) for _, message in _told(run)]
    for sent, one in sent_frames(run, "/tf"):
        stamp = since_start(one.header.stamp)
        if min(abs(stamp - known) for known in stamps) > 1e-6:
            hint = (
                "Without a stamp it is a transform of time 0."
                if one.header.stamp == Time()
                else "Take header.stamp of the odometry: that is when the robot was there."
            )
            nearest = max((known for known in stamps if known <= sent), default=stamps[0])
            raise Missed(f"the stamp of {nearest:.3f} s", stamp_words(one.header.stamp), hint)
    known = {str(one.header.stamp) for _, one in sent_frames(run, "/tf")}
    if len(known) < OFTEN * len(stamps):
        hint = "Each odometry has a stamp of its own: take header.stamp of the one that has just come."
        raise Missed(f"{len(stamps)} stamps, one for each odometry", f"{len(known)}", hint)


def _told(run: Recording) -> list[tuple[float, Odometry]]:
    """What the wheels said, and when."""
    told = [(heard.stamp, heard.message) for heard in run.messages("/wheels/odom") if heard.from_course]
    if len(told) < 5:
        raise no_data(run, "odometry", f"{len(told)}", run.graph.publishers("/wheels/odom"))
    return told
