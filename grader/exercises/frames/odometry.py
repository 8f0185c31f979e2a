"""Broadcast a moving frame: where odometry has the robot."""

import math

from builtin_interfaces.msg import Time

from grader.checks import Missed, otherwise, publishes, subscribes
from grader.checks.fields import stamp_words
from grader.checks.frames import FULL_TURN, NEAR, PART, TF, Broadcast, between, broadcasts
from grader.companions.moving_frames import WheelOdometry
from grader.exercise import Exercise
from grader.geometry import Pose2D
from grader.responses import Window, from_course, same
from grader.variants import Variants
from sim.evidence import Message, Recording, since_start

WHEELS = "/wheels/odom"
SOON = 0.05  # s
EARLY = 0.3  # s; until then, a place may be right by accident
OFTEN = 0.3  # of the odometries

odometry = Exercise("odometry", "From odometry to a frame", seconds=4, companions=[WheelOdometry],
                    seeds=(1, 2), variants=Variants(
    {"child": ("base_link", "base_footprint", "chassis")},
    texts=("child `{child}`", "child {child}", '"odom", "{child}"'),
))


@odometry.check(2, guess="A TransformBroadcaster's sendTransform publishes on /tf: call it in the callback.")
def subscribes_and_broadcasts(run: Recording) -> None:
    """The node subscribes to /wheels/odom, and publishes transforms on /tf."""
    subscribes(run, WHEELS, "nav_msgs/msg/Odometry")
    publishes(run, "/tf", TF)


@odometry.check(5, after=subscribes_and_broadcasts, hints={
    "That is an earlier pose. Send in the callback of /wheels/odom, not from a timer.":
        lambda run, sent, poses: _is_late(sent, poses),
    "translation is the position: x and y of pose.pose.position in the same message.":
        lambda run, sent, poses: not _is_placed(sent, poses),
    f"rotation is pose.pose.orientation: copy all four numbers. {FULL_TURN}": otherwise,
})
def puts_it_there(run: Recording) -> None:
    """The parent is odom, the child base_link, and position and rotation are the odometry's."""
    rows, sent, wrong = _odometry(run), broadcasts(run, "/tf"), []
    for one in sent:
        poses = [Pose2D.from_message(row.message.pose.pose) for row in Window(0.0, one.stamp).rows(rows)]
        if poses and not (one.is_rotation and one.pose.is_near(poses[-1], NEAR, NEAR)):
            wrong.append((one, poses))
    between(sent, "odom", odometry.drawn.child, "/tf", lambda one: not wrong)
    if wrong:
        first, poses = wrong[0]
        later = [_is_partly_right(*pair) for pair in wrong if pair[0].stamp > EARLY]
        credit = PART if later and all(later) else 0.0
        expected = f"{poses[-1]} at {first.stamp:.3g} s"
        raise Missed(expected, f"{first.pose}", about=(first, poses), credit=credit)
    if len(sent) < OFTEN * len(rows):
        hint = "The robot keeps moving: send in the callback of /wheels/odom, every time it is called."
        raise Missed(f"a transform for each of {len(rows)} odometry messages", f"{len(sent)}", hint)


@odometry.check(3, after=puts_it_there)
def one_for_each(run: Recording) -> None:
    """Each odometry message gives one transform, at once."""
    sent = broadcasts(run, "/tf")
    for row in _odometry(run)[:-1]:  # the answer to the last may not have come
        count = len(Window.after(row.stamp, SOON).rows(sent))
        if count != 1:
            hint = f"Send in the callback of {WHEELS}: one transform for each message, and none from a timer."
            expected = f"one transform for the odometry at {row.stamp:.3g} s, within {SOON:g} s"
            raise Missed(expected, f"{count}", hint)


@odometry.check(4, after=puts_it_there)
def stamps_it(run: Recording) -> None:
    """The transform has the odometry's stamp: when it was measured, not when it was sent."""
    stamps = [since_start(row.message.header.stamp) for row in _odometry(run)]
    sent = broadcasts(run, "/tf")
    for one in sent:
        if not any(same(one.measured, stamp) for stamp in stamps):
            stamp = one.message.header.stamp
            hint = "Use the header.stamp of the odometry message: that is when the robot was there."
            if stamp == Time():
                hint = ("Without a stamp the transform is for time 0: copy the header.stamp of the odometry "
                        "message.")
            nearest = max((known for known in stamps if known <= one.stamp), default=stamps[0])
            raise Missed(f"the stamp of {nearest:.3f} s", stamp_words(stamp), hint)
    count = len({one.measured for one in sent})
    if count < OFTEN * len(stamps):
        hint = ("Every odometry message has its own stamp: use the header.stamp of the one that has just "
                "arrived.")
        raise Missed(f"{len(stamps)} stamps, one for each odometry message", f"{count}", hint)


def _odometry(run: Recording) -> list[Message]:
    return from_course(run, WHEELS, at_least=5, what="odometry")


def _is_partly_right(sent: Broadcast, poses: list[Pose2D]) -> bool:
    """Return whether a wrong transform is right in one thing. poses: by the odometry so far."""
    turned = abs(math.remainder(sent.pose.yaw - poses[-1].yaw, math.tau)) <= NEAR and sent.is_rotation
    return turned or _is_placed(sent, poses) or _is_late(sent, poses)


def _is_placed(sent: Broadcast, poses: list[Pose2D]) -> bool:
    return math.dist(sent.pose[:2], poses[-1][:2]) <= NEAR


def _is_late(sent: Broadcast, poses: list[Pose2D]) -> bool:
    """Return whether the robot was there a moment ago."""
    return any(sent.pose.is_near(pose, NEAR, NEAR) for pose in poses[-3:])
