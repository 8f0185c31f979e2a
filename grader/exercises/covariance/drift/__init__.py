"""Wheel odometry whose covariance states how far it may be off."""

from __future__ import annotations

import math

import numpy as np

from grader.checks import Missed, otherwise, publishes, subscribes
from grader.exercise import Exercise
from grader.exercises.covariance.drift.beliefs import (
    AXES,
    TINY,
    Belief,
    is_covariance,
    is_turned,
    median,
    nees,
    pose_of,
    ratio,
    text_of,
    yaw_nees,
)
from grader.exercises.covariance.drift.short_drives import DRIVES, PERIOD, SECONDS, STEPS, drives, encoders
from grader.geometry.near import is_near
from grader.variants import Variants
from sim.evidence import Message, Recording, since_start

SAME, NEAR = 1e-3, 5e-3  # relative; m and rad
# 95 % of all sets of 50 drives with an honest covariance are between these, of 3 and of 1 dimensions.
WHOLE, YAW = (117.98 / DRIVES, 185.80 / DRIVES), (32.36 / DRIVES, 71.42 / DRIVES)
LOSS = 0.5  # by which the mean log score may be worse than the best possible
HUGE = 0.05  # a mean squared error in units of the covariance below this is next to nothing
DEGREES = math.degrees(1.0) ** 2

drift = Exercise("drift", "Odometry that knows how far it may be off", seconds=SECONDS, companions=encoders,
                 variants=Variants({"topic": ("/wheel_odom", "/encoder_odom", "/dead_reckoning")},
                                   texts=("{topic}",)))

__all__ = ["drift", "encoders"]


@drift.check(1)
def publishes_odometry(run: Recording) -> list[list[Message]]:
    """For each message on /joint_states the node publishes an Odometry on /wheel_odom with the same stamp."""
    subscribes(run, "/joint_states", "sensor_msgs/msg/JointState")
    sent = publishes(run, drift.drawn.topic, "nav_msgs/msg/Odometry", at_least=STEPS)
    frames = {(row.message.header.frame_id, row.message.child_frame_id) for row in sent}
    if frames != {("odom", "base_link")}:
        names = " and ".join(map(repr, max(frames - {("odom", "base_link")})))
        hint = "A pose is in header.frame_id, and belongs to child_frame_id."
        raise Missed("odometry from 'odom' to 'base_link'", names, hint)
    found = {since_start(row.message.header.stamp): row for row in sent}
    moments = [since_start(row.message.header.stamp) for row in run.messages("/joint_states")]
    missing = [moment for moment in moments if moment not in found and moment < run.ended.stamp - PERIOD]
    if missing or len(moments) < DRIVES * STEPS:
        saw = f"none for the one at {min([*missing, run.ended.stamp]):.4g} s"
        hint = "Publish in the callback of /joint_states, with header.stamp = msg.header.stamp."
        raise Missed("an Odometry with the stamp of each JointState", saw, hint)
    rows = [found.get(moment, sent[-1]) for moment in moments]
    return [rows[begin : begin + STEPS] for begin in range(0, len(rows), STEPS)]


@drift.check(1, after=publishes_odometry)
def pose_is_right(run: Recording, parts: list[list[Message]]) -> list[Belief]:
    """The pose is what the wheels read, and begins at zero after each message on /reset_odometry."""
    beliefs = []
    for part, drive in zip(parts, drives(run.seed), strict=False):
        poses = np.array([pose_of(row.message.pose.pose) for row in part])
        spreads = np.array([np.reshape(row.message.pose.covariance, (6, 6)) for row in part])
        beliefs.append(Belief(drive, poses, spreads))
        off = poses - drive.believed
        turns = [math.remainder(turn, math.tau) if math.isfinite(turn) else math.nan for turn in off[:, 2]]
        worst = np.abs(np.column_stack([off[:, :2], turns])).max(axis=1)
        wrong = next((step for step, error in enumerate(worst) if not is_near(error, 0.0, NEAR)), None)
        if wrong is not None:
            expected, saw = (text_of(pose) for pose in (drive.believed[wrong], poses[wrong]))
            hint = "Set x, y and yaw to 0 when /reset_odometry arrives; the wheels' angles continue."
            raise Missed(f"{expected} at {part[wrong].stamp:.4g} s", saw, hint)
    return beliefs


@drift.check(1, after=pose_is_right, hints={
    "nan and infinity are no variances: did you divide by zero?":
        lambda run, beliefs: not all(np.isfinite(belief.covariances).all() for belief in beliefs),
    "All of it is 0, which claims that the pose is certain. Add the variance of each step.":
        lambda run, beliefs: not any(belief.covariances.any() for belief in beliefs),
    "The variance of yaw is number 35: rows and columns are x, y, z and the turns about x, y and z, six of "
    "each. Number 7 is that of y.":
        lambda run, beliefs: median(beliefs, 0) > 0 and not median(beliefs, 35) > TINY,
    "Rolling backwards makes the robot less certain, too: a wheel's variance grows with abs(distance).":
        lambda run, beliefs: any((np.diagonal(each.covariances, axis1=1, axis2=2) < -TINY).any()
                                 for each in beliefs),
    "Number 6 * row + column is the covariance of two of x, y, z and the turns: the variances are at 0, 7 "
    "and 35, and the number in row 0, column 5 is also in row 5, column 0.": otherwise,
})
def is_a_covariance(run: Recording, beliefs: list[Belief]) -> list[Belief]:
    """Its covariance is one: symmetric, no variance is negative, and none of x, y, yaw is 0 after a drive."""
    for number, belief in enumerate(beliefs, 1):
        for step, whole in enumerate(belief.covariances):
            part, last = whole[AXES], step == len(belief.covariances) - 1
            if not np.isfinite(whole).all() or not is_covariance(part, TINY if last else -1e-12):
                numbers = ", ".join(f"{value:.3g}" for value in part.flat)
                raise Missed("a covariance of x, y and yaw, with variances above 0 at the end of a drive",
                             f"{numbers} in drive {number} after {step * PERIOD:.1f} s", about=(beliefs,))
    return beliefs


@drift.check(2, after=is_a_covariance)
def stays_at_rest(run: Recording, beliefs: list[Belief]) -> None:
    """The covariance is 0 after a reset, and stays the same while the wheels stand still."""
    for number, belief in enumerate(beliefs, 1):
        first = belief.covariances[0][AXES]
        if not np.allclose(first, 0.0, atol=TINY):
            hint = "A reset defines where the robot is: there is no error yet. Set the covariance to 0, too."
            raise Missed(f"0 in the first message of drive {number}", f"{first[0, 0]:.3g} m² for x", hint)
        rests = np.flatnonzero(~belief.drive.rolled.any(axis=1))
        for step in rests[rests > 0]:
            before, after = (belief.covariances[each][AXES] for each in (step - 1, step))
            if not np.allclose(after, before, rtol=SAME, atol=TINY):
                grown = after[2, 2] - before[2, 2]
                saw = f"a variance of yaw that changed by {grown:.2g} rad² in drive {number}"
                hint = ("Wheels that stand don't slip. The variance grows with the distance rolled, not with "
                        "time or with each message.")
                raise Missed(f"no change in {PERIOD:g} s in which no wheel turned", saw, hint)


@drift.check(2, after=is_a_covariance, hints={
    "That is in degrees: variances of angles are in rad².":
        lambda run, beliefs: 0.3 * DEGREES < ratio(beliefs, 2) < 3 * DEGREES,
    "That covers every error, so it says nothing: a program that uses it ignores your odometry. Let the "
    "variance grow with the distance.":
        lambda run, beliefs: nees(beliefs) < HUGE,
    "A covariance has variances, the squares of standard deviations.":
        lambda run, beliefs: 0.5 < np.median([each.covariance[2, 2] ** 2 / each.drive.spread[2, 2]
                                              for each in beliefs]) < 2.0,
    "The yaw's variance is right, but x and y are off by more than that: a wrong yaw takes the robot aside "
    "on every later step. Propagate P by F @ P @ F.T, with the derivatives of x and y by the yaw in F.":
        lambda run, beliefs: YAW[0] < yaw_nees(beliefs) < YAW[1] and ratio(beliefs, 1) < 0.7,
    "The ellipses are turned by the robot's yaw: x and y are the axes of odom, not of the robot.":
        lambda run, beliefs: is_turned(beliefs, WHOLE),
    "It is too small: the errors are larger than it allows. Does each wheel's variance grow by SLIP**2 per "
    "meter, from the beginning of each drive on?":
        lambda run, beliefs: nees(beliefs) > WHOLE[1] or yaw_nees(beliefs) > YAW[1],
    "It is too large: the errors are smaller than it allows. Does it start at 0 after each reset, and does "
    "each wheel's variance grow by SLIP**2 per meter?": otherwise,
})
def is_consistent(run: Recording, beliefs: list[Belief]) -> list[Belief]:
    """Over 50 drives the errors are as large as the covariance says (NEES within its 95 % bounds)."""
    whole, yaw = nees(beliefs), yaw_nees(beliefs)
    if not (WHOLE[0] <= whole <= WHOLE[1] and YAW[0] <= yaw <= YAW[1]):
        expected = (f"a mean squared error of {WHOLE[0]:.2f} to {WHOLE[1]:.2f} in units of the covariance, "
                    f"and {YAW[0]:.2f} to {YAW[1]:.2f} for yaw alone")
        raise Missed(expected, f"{whole:.3g}, and {yaw:.3g} for yaw", about=(beliefs,))
    return beliefs


@drift.check(3, after=is_consistent, hints={
    "Each variance is right, but x, y and yaw are wrong together: a turn to the left takes the robot to the "
    "left. Publish the covariances between them as well, numbers 1, 5 and 11, and 6, 30 and 31.":
        lambda run, beliefs: all(0.6 < ratio(beliefs, axis) < 1.7 for axis in range(3))
        and not any(each.covariance[0, 2] or each.covariance[1, 2] for each in beliefs),
    "A covariance that is right on average isn't right for each drive: after a short one the robot is more "
    "certain than after a long one.": otherwise,
})
def is_sharp(run: Recording, beliefs: list[Belief]) -> None:
    """In each drive it says as much as can be said (the mean log score is close to the best possible)."""
    own = float(np.mean([belief.score(belief.covariance) for belief in beliefs]))
    best = float(np.mean([belief.score(belief.drive.spread) for belief in beliefs]))
    if not own <= best + LOSS:
        expected = f"-log of the density at the true pose: {best + LOSS:.2f} or less, on average"
        raise Missed(expected, f"{own:.4g}", about=(beliefs,))
