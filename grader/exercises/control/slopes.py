"""An exercise on PI, on wind-up and on a filter: stop in front of a wall, on a slope."""

from __future__ import annotations

import itertools
import math

from grader.checks import Missed, hinting, keeps_clear, publishes, within
from grader.checks.no_data import no_data
from grader.exercise import Exercise
from grader.exercises.control.partners import MOST, Slope
from grader.exercises.control.places import ramp
from sim.evidence import Recording

FLOAT = "std_msgs/msg/Float64"
WEIGHT = 0.2
TARGET, BEYOND, NEAR, COMES = 0.6, 0.12, 0.03, 0.85  # m
LAST, PERIOD = 4.0, 0.05  # s; from one scan to the next
HELD = 0.4  # of the scans: fewer, and the motors brake
CLOSE, SAME = 1e-3, 1e-9  # m
WIND_UP = (
    "All the way to the wall the error is large and the motor at its limit: the sum grows and grows, and "
    "has to be worn off behind the goal. While the speed is cut, don't add to the sum."
)
SIGN = (
    "The error is the distance minus 0.6 m: far from the wall it is positive, and so is the speed. Is the "
    "sign right, and P large enough?"
)
GOAL = "The error is the distance minus 0.6 m: it is 0 where the robot has to stand, and not at the wall."

gap = Exercise("gap", "Stop in front of the wall", world=ramp, seconds=24, companions=[Slope], seeds=(1, 2))


@gap.check(2)
def speaks(run: Recording) -> None:
    """The node publishes /distance and /speed with each scan."""
    for topic in ("/distance", "/speed"):
        publishes(run, topic, FLOAT, at_least=10)


@gap.check(4, after=speaks)
def filters(run: Recording) -> None:
    """/distance is what the lidar sees ahead, filtered: a fifth of what is new, four fifths of what was."""
    raw = [heard.message.ranges[0] for heard in run.messages("/scan") if heard.from_course]
    said = [heard.message.data for heard in run.messages("/distance")]
    if not raw:
        raise no_data(run, "scans", "none", run.graph.publishers("/scan"))
    # The first scans may be sent before the node is there; a scan in the end may be unanswered.
    first = next((n for n in range(min(len(raw), 6)) if abs(said[0] - raw[n]) < SAME), 0)
    raw = raw[first:]
    if not len(raw) - 2 <= len(said) <= len(raw):
        hint = "Publish in the callback of /scan, each time it is called."
        raise Missed(f"{len(raw)} messages on /distance", f"{len(said)}", hint)
    # Too near and too far a ray says inf: what comes of that is not asked.
    true = _filtered(list(itertools.takewhile(math.isfinite, raw)), WEIGHT)
    for number, (one, right) in enumerate(zip(said, true, strict=False), 1):
        if not abs(one - right) < CLOSE:
            hint = _why_not_filtered(said[: len(true)], raw)
            raise Missed(f"{right:.3f} m as number {number} on /distance", f"{one:.3f} m", hint)


@gap.check(4, after=speaks)
def does_not_run_into_the_wall(run: Recording) -> None:
    """The robot comes to the wall, up to 0.85 m or less, and never nearer than 0.48 m. It touches nothing."""
    wall, hint = run.world.bounds[2], _why_too_near(run)
    keeps_clear(run, hint)
    nearest, stamp = min((wall - pose.x, pose.stamp) for pose in run.path)
    last = wall - run.path[-1].x
    if last > COMES:
        raise Missed(f"{COMES:g} m or less to the wall at the end", f"{last:.2f} m", SIGN, picture="path")
    if nearest < TARGET - BEYOND:
        saw = f"{nearest:.2f} m at {stamp:.3g} s"
        raise Missed(f"{TARGET - BEYOND:g} m or more to the wall", saw, hint, picture="path")


@gap.check(2, after=does_not_run_into_the_wall)
def keeps_within_the_limit(run: Recording) -> None:
    """No speed is beyond 0.3 m/s, either way."""
    with hinting(f"Cut it before you publish it: max(-{MOST:g}, min({MOST:g}, speed))."):
        within(run, "/speed", "data", -MOST, MOST, unit="m/s")


@gap.check(4, after=does_not_run_into_the_wall)
def stands_at_the_distance(run: Recording) -> None:
    """In the last four seconds it stands 0.6 m from the wall, within 3 cm."""
    wall = run.world.bounds[2]
    last = [wall - pose.x for pose in run.path if pose.stamp >= run.ended.stamp - LAST]
    speeds = [heard.message.data for heard in run.messages("/speed") if heard.stamp >= run.ended.stamp - LAST]
    held = sum(map(math.isfinite, speeds))
    if held < HELD * LAST / PERIOD:
        hint = "A node that says nothing leaves it to the brake: publish a speed with each scan, to the end."
        raise Missed(f"a speed with each scan in the last {LAST:g} s", f"{held} of them", hint)
    worst = max(last, key=lambda distance: abs(distance - TARGET), default=math.inf)
    if abs(worst - TARGET) > NEAR:
        hint = (
            "P alone stands where its push is as strong as the pull of the slope. I takes the rest "
            "away: the sum of error times time."
            if worst > TARGET
            else WIND_UP
        )
        raise Missed(f"{TARGET:g} m, within {NEAR * 100:g} cm", f"{worst:.2f} m", hint, picture="path")


def _why_too_near(run: Recording) -> str:
    """What led to the wall: a wrong sign, a sum that was wound up, or another goal."""
    wall, speeds = run.world.bounds[2], run.messages("/speed")
    if speeds[0].message.data < 0:
        return SIGN
    passed = next((pose.stamp for pose in run.path if wall - pose.x < TARGET), math.inf)
    then = [heard.message.data for heard in speeds if heard.stamp <= passed]
    return WIND_UP if then[-1] > 0.9 * MOST else GOAL


def _filtered(values: list[float], weight: float) -> list[float]:
    """Values after a low-pass filter of first order that begins with the first of them."""
    found = [values[0]]
    for value in values[1:]:
        found.append(found[-1] + weight * (value - found[-1]))
    return found


def _why_not_filtered(said: list[float], raw: list[float]) -> str:
    def alike(wrong: list[float]) -> bool:
        return all(abs(a - b) < CLOSE for a, b in zip(said, wrong, strict=False))

    if alike(raw):
        return "That is the scan itself, with all its noise: mix it with what you had before."
    if alike(_filtered(raw, 1 - WEIGHT)):
        return "The weights are swapped: a fifth of the new value, four fifths of the old one."
    if said[0] < raw[0] / 2:
        return "It begins at 0: take the first distance as it is."
    return "self.distance + 0.2 * (new - self.distance), and keep it for the next scan."
