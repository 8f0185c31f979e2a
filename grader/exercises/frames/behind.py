"""A design exercise: follow another robot by transforms."""

import math
import statistics
from functools import partial

from grader.checks import Missed, keeps_clear, lasts, otherwise, publishes, stands_still, subscribes
from grader.checks.frames import TF
from grader.companions.transforms import LEADER, LosesTheLeader, localization
from grader.exercise import Exercise, Scenario
from grader.geometry import Pose2D
from grader.geometry.near import is_near
from grader.responses import from_student, last_before, stands_without_transforms
from grader.worlds.frame_worlds import convoy, parked
from grader.worlds.trusting import trusting
from sim.evidence import Recording, Seconds

GAP, BAND = 1.0, 0.25  # m
NEAREST, FARTHEST = 0.7, 1.4  # m
SETTLED, CLEAR = 9.0, 0.2  # s; rad, from which on the side is clear
LATE = 1.0  # s, after which the frames of the two robots are connected in one of the runs
WHY_OFF = {
    "Target and source are swapped: lookup_transform(target, source, time) gives the pose of the source, "
    "seen from the target. The target is the robot's own frame, base_link, and the source the leader's.":
        lambda run, gaps: _looks_from_the_leader(run),
    "The robot hardly moves. Does the lookup fail each time, or wait for a time before the first transform? "
    "Log the exception: it says why. And is the robot's own frame, base_link, the target?":
        lambda run, gaps: math.dist(run.path[0][1:3], run.path[-1][1:3]) < 0.1,
    "It is too close: the point 1 m behind the leader is at x = -1 in leader/base_link.":
        lambda run, gaps: gaps and statistics.mean(gaps.values()) < 0.75,
    "It loses the leader. Look up where the point is in base_link, the robot's own frame: odom "
    "and leader/odom are two different frames, and only the tf tree relates them.":
        lambda run, gaps: gaps and statistics.mean(gaps.values()) > 2.0,
    "Print the point that the robot drives to, in the map. Is it where it should be? If so: does the robot "
    "turn towards it, and is it fast enough to catch up?": otherwise,
}

behind = Exercise("behind", "Follow the leader, your way", scenarios=[
    Scenario(convoy, 22, 1, companions=lambda seed: localization(convoy(seed)), name="driving"),
    Scenario(parked, 14, 2, companions=lambda seed: localization(parked(seed), LATE), name="parked"),
    Scenario(trusting(convoy), 15, 3, companions=lambda seed: [partial(LosesTheLeader, convoy(seed))],
             name="lost"),
])


@behind.check(2, guess="A TransformListener subscribes to both topics. Publish in the timer's callback.")
def subscribes_and_drives(run: Recording) -> None:
    """The node subscribes to /tf and /tf_static, and sends Twist messages on /cmd_vel."""
    subscribes(run, "/tf", TF)
    subscribes(run, "/tf_static", TF)
    publishes(run, "/cmd_vel", "geometry_msgs/msg/Twist", at_least=5)


@behind.check(9, after=subscribes_and_drives, only="driving", hints=WHY_OFF)
def keeps_the_gap(run: Recording) -> None:
    """From 9 s on the robot is 0.7 m to 1.4 m from the leader, for at least nine tenths of the time."""
    gaps = _gaps(run)
    if not gaps:
        raise Missed(f"a robot that follows until {SETTLED:g} s and longer", "the run ended earlier")
    off = {stamp: gap for stamp, gap in gaps.items() if not NEAREST <= gap <= FARTHEST}
    if len(off) > 0.1 * len(gaps):
        stamp, gap = max(off.items(), key=lambda row: abs(row[1] - GAP))
        saw = f"{gap:.2f} m at {stamp:.3g} s; outside in {len(off) / len(gaps):.0%} of the time"
        expected = f"{NEAREST:g} m to {FARTHEST:g} m between the two robots"
        raise Missed(expected, saw, about=(gaps,), picture="path")


@behind.check(4, after=subscribes_and_drives, only="parked", hints=WHY_OFF)
def stands_behind_one_who_stands(run: Recording) -> None:
    """When the leader has stopped, the robot stops within 0.25 m of the point 1 m behind it."""
    robot, leader = run.path[-1], run.tracks["leader"][-1]
    error = math.dist(robot[1:3], Pose2D(*leader[1:]).point((-GAP, 0.0)))
    if not error <= BAND:
        expected = f"the robot within {BAND:g} m of the point {GAP:g} m behind the leader at the end"
        raise Missed(expected, f"{error:.2f} m away", about=(_gaps(run),), picture="path")
    stands_still(run, last=2.0, tolerance=0.05)


@behind.check(3, after=subscribes_and_drives, only="lost")
def stops_when_it_knows_nothing_new(run: Recording) -> None:
    """When no new transforms of the leader arrive, the robot stops within 1.5 s."""
    stands_without_transforms(run, LEADER, "of the leader", "First let the robot follow the leader.")


@behind.check(4, after=keeps_the_gap)
def touches_nothing(run: Recording) -> None:
    """The robot touches nothing and no one."""
    keeps_clear(run, "Does it aim at the leader itself? Where should it slow down, and where stop?")
    lasts(run, "/cmd_vel")


def _looks_from_the_leader(run: Recording) -> bool:
    """Return whether the robot turns to where the point would be, were the two frames swapped."""
    turns = []
    for row in from_student(run, "/cmd_vel"):
        robot, leader = (last_before(path, row.stamp) for path in (run.path, run.tracks["leader"]))
        if robot and leader:
            there, here = Pose2D(*robot[1:]), Pose2D(*leader[1:])
            right, swapped = _side(there, here), _side(here, there)
            if not (is_near(right, 0.0, CLEAR) or is_near(swapped, 0.0, CLEAR)) and right * swapped < 0:
                turns.append(row.message.angular.z * swapped)
    return len(turns) > 5 and sum(turn > 0 for turn in turns) > 0.8 * len(turns)


def _side(own: Pose2D, other: Pose2D) -> float:
    """The angle (rad) at which a robot sees the point behind another one."""
    x, y = other.point((-GAP, 0.0))
    return math.remainder(math.atan2(y - own.y, x - own.x) - own.yaw, math.tau)


def _gaps(run: Recording) -> dict[Seconds, float]:
    """The distance (m) between the two robots at each moment from when the robot should have caught up."""
    pairs = zip(run.path, run.tracks["leader"], strict=False)
    return {pose.stamp: math.dist(pose[1:3], other[1:3]) for pose, other in pairs if pose.stamp >= SETTLED}
