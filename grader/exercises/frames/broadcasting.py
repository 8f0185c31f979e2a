"""An exercise on moving frames: broadcast what odometry says."""

from __future__ import annotations

import math
import random

from nav_msgs.msg import Odometry
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time

from grader.checks import Missed, hinting, publishes, subscribes
from grader.checks.silence import silence
from grader.exercise import Exercise
from grader.exercises.frames.measures import (
    FULL_TURN,
    TF,
    alike,
    flat,
    is_turn,
    named_right,
    place,
    sent_frames,
)
from sim.evidence import Recording

ODOMETRY = "nav_msgs/msg/Odometry"
PERIOD = 0.1  # s
SOON = 0.05  # s


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
    for sent, one in named_right(list(sent_frames(run, "/tf")), "odom", "base_link", "/tf"):
        before = [message.pose.pose for stamp, message in told if stamp <= sent + 1e-6]
        if not before:
            continue
        turn, position = before[-1].orientation, before[-1].position
        wanted = position.x, position.y, 2 * math.atan2(turn.z, turn.w)
        wanted = (*wanted[:2], math.remainder(wanted[2], math.tau))
        if not is_turn(one.transform) or not alike(flat(one.transform), wanted):
            hint = "Parts of rotation are those of pose.pose.orientation, all four. " + FULL_TURN
            if math.dist(flat(one.transform)[:2], wanted[:2]) > 0.02:
                hint = "translation is the position, pose.pose.position: x and y of the same message."
            raise Missed(f"{place(wanted)} at {sent:.3g} s", place(flat(one.transform)), hint)


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
    stamps = [_seconds(message.header.stamp) for _, message in _told(run)]
    for sent, one in sent_frames(run, "/tf"):
        stamp = _seconds(one.header.stamp)
        if min(abs(stamp - known) for known in stamps) > 1e-6:
            hint = (
                "Without a stamp it is a transform of time 0."
                if stamp == 0.0
                else "Take header.stamp of the odometry: that is when the robot was there."
            )
            nearest = max((known for known in stamps if known <= sent), default=stamps[0])
            raise Missed(f"the stamp {nearest:.3f} s", f"{stamp:.3f} s", hint)


def _told(run: Recording) -> list[tuple[float, Odometry]]:
    """What the wheels said, and when."""
    told = [(heard.stamp, heard.message) for heard in run.messages("/wheels/odom") if heard.ours]
    if len(told) < 5:
        raise silence(run, "odometry", f"{len(told)}", run.graph.publishers("/wheels/odom"))
    return told


def _seconds(stamp: object) -> float:
    return Time.from_msg(stamp).nanoseconds / 1e9
