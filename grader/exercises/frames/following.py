"""The project: a robot that follows another one, by transforms."""

from __future__ import annotations

import math

from grader.checks import Missed, hinting, keeps_clear, lasts, publishes, stands_still, subscribes
from grader.exercise import Exercise, Scenario
from grader.exercises.frames.partners import localization
from grader.exercises.frames.places import convoy, parked
from sim.evidence import Pose, Recording

TWIST, TF = "geometry_msgs/msg/Twist", "tf2_msgs/msg/TFMessage"
GAP, BAND = 1.0, 0.25  # m
NEAREST, FARTHEST = 0.7, 1.4  # m
SETTLED = 9.0  # s

behind = Exercise(
    "behind",
    "Follow the leader",
    scenarios=[
        Scenario(convoy, 22, 1, companions=lambda seed: localization(convoy(seed)), name="driving"),
        Scenario(parked, 14, 2, companions=lambda seed: localization(parked(seed)), name="parked"),
    ],
)


@behind.check(2)
def hears_frames_and_drives(run: Recording) -> None:
    """The node hears /tf and /tf_static, and sends Twist messages on /cmd_vel."""
    with hinting(guess="A TransformListener hears both topics. Publish in the timer's callback."):
        subscribes(run, "/tf", TF)
        subscribes(run, "/tf_static", TF)
        publishes(run, "/cmd_vel", TWIST, at_least=5)


@behind.check(11, after=hears_frames_and_drives, only="driving")
def keeps_the_gap(run: Recording) -> None:
    """From 9 s on it is 0.7 m to 1.4 m from the leader, for nine tenths of the time."""
    gaps = [(pose.stamp, _gap(pose, leader)) for pose, leader in _pairs(run) if pose.stamp >= SETTLED]
    if not gaps:
        raise Missed(f"a robot that follows until {SETTLED:g} s and longer", "the run ended before")
    off = [(stamp, gap) for stamp, gap in gaps if not NEAREST <= gap <= FARTHEST]
    if len(off) > 0.1 * len(gaps):
        stamp, gap = max(off, key=lambda row: abs(row[1] - GAP))
        saw = f"{gap:.2f} m at {stamp:.3g} s; outside in {len(off) / len(gaps):.0%} of the time"
        expected = f"{NEAREST:g} m to {FARTHEST:g} m between the two robots"
        raise Missed(expected, saw, _why_off(run), picture="path")


@behind.check(5, after=hears_frames_and_drives, only="parked")
def stands_behind_one_who_stands(run: Recording) -> None:
    """Behind a leader that stands, it comes to stand itself, within 0.25 m of that point."""
    pose, leader = _pairs(run)[-1]
    error = _error(pose, leader)
    if not error <= BAND:
        expected = f"the robot within {BAND:g} m of the point {GAP:g} m behind the leader at the end"
        raise Missed(expected, f"{error:.2f} m away", _why_off(run), picture="path")
    with hinting("Near the point, send zeros: else it turns to and fro for ever."):
        stands_still(run, last=2.0, tolerance=0.05)


@behind.check(4, after=keeps_the_gap)
def touches_nothing(run: Recording) -> None:
    """The robot touches nothing, and nobody."""
    keeps_clear(
        run,
        "Does it aim at the leader itself? Aim at the point 1 m behind, and slow down there.",
    )
    lasts(run, "/cmd_vel")


def _pairs(run: Recording) -> list[tuple[Pose, Pose]]:
    """The robot and the leader, at the same moments."""
    return list(zip(run.path, run.tracks["leader"], strict=False))


def _gap(pose: Pose, leader: Pose) -> float:
    return math.dist((pose.x, pose.y), (leader.x, leader.y))


def _error(pose: Pose, leader: Pose) -> float:
    """How far the robot is from where it should be, m."""
    behind = leader.x - GAP * math.cos(leader.yaw), leader.y - GAP * math.sin(leader.yaw)
    return math.dist((pose.x, pose.y), behind)


def _why_off(run: Recording) -> str:
    pairs = [pair for pair in _pairs(run) if pair[0].stamp >= SETTLED]
    gaps = [_gap(pose, leader) for pose, leader in pairs]
    moved = math.dist((run.path[0].x, run.path[0].y), (run.path[-1].x, run.path[-1].y))
    if moved < 0.1:
        return (
            "The robot hardly moves. Does the lookup fail each time? Log the error: it says why. And is the "
            "robot's own frame, base_link, the target?"
        )
    if sum(gaps) / len(gaps) < 0.75:
        return "It is too near: the point 1 m behind the leader is at x = -1 in leader/base_link."
    if sum(gaps) / len(gaps) > 2.0:
        return (
            "It loses the leader. Ask where the point is in base_link, the robot's own frame: odom and "
            "leader/odom are two frames, and only the tree knows how they lie."
        )
    return "Steer by the angle atan2(y, x) of the point in base_link, in rad; drive faster the farther it is."
