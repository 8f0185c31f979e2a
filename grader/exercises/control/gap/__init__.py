"""PI, wind-up and a filter: stop in front of a wall, on a slope."""

import itertools
import math

from grader.checks import Missed, hinting, keeps_clear, otherwise, publishes, within
from grader.checks.motion import world_in
from grader.exercise import Exercise
from grader.exercises.control.gap.slope import MOST, Slope
from grader.geometry.near import is_near
from grader.responses import EDGE, Window, from_course, last_before, matches, same
from grader.variants import Variants
from grader.worlds.frame_worlds import ramp
from sim.evidence import Recording, Seconds

__all__ = ["Slope", "gap"]

FLOAT = "std_msgs/msg/Float64"
NEAR = 0.03  # m
LAST, PERIOD = 4.0, 0.05  # s; from one scan to the next
HELD = 0.4  # of the scans: fewer, and the motors brake
CLOSE = 1e-3  # m
WIND_UP = ("On the way to the wall the error is large and the speed is at its limit: the sum keeps growing, "
           "and only an overshoot reduces it again. While the speed is clipped, don't add to the sum.")
SIGN = ("The error is the distance minus 0.6 m: far from the wall it is positive, and so is the speed. Is "
        "the sign right, and is P large enough?")

gap = Exercise("gap", "Stop in front of the wall", world=ramp, seconds=24, companions=[Slope], seeds=(1, 2),
               variants=Variants(
    {"target": (0.6, 0.7, 0.65), "least": (0.48, 0.58, 0.53), "comes": (0.85, 0.95, 0.9)},  # m
    {"weight": (0.2, 0.25), "part": ("a fifth", "a quarter"), "rest": ("four fifths", "three quarters")},
    texts=("{target} m", "{least} m", "{comes} m", "distance - {target}", "{part} of the new",
           "{rest} of the old", "{weight} * (new"),
))


@gap.check(2)
def publishes_both(run: Recording) -> None:
    """The node publishes /distance and /speed with each scan."""
    for topic in ("/distance", "/speed"):
        publishes(run, topic, FLOAT, at_least=10)


@gap.check(4, after=publishes_both, hints={
    "That is the raw scan, with all its noise: mix it with your previous value.":
        lambda run, sent, scans: matches(sent, scans, CLOSE),
    "The weights are swapped: a fifth of the new value, four fifths of the old one.":
        lambda run, sent, scans: matches(sent, _filtered(scans, 1 - gap.drawn.weight), CLOSE),
    "It begins at 0: use the first distance unfiltered.": lambda run, sent, scans: sent[0] < scans[0] / 2,
    "Compute self.distance + 0.2 * (new - self.distance), and store it in self.distance for the next "
    "scan.": otherwise,
})
def filters(run: Recording) -> None:
    """/distance is what the lidar sees ahead, filtered: a fifth of the new value, four fifths of the old."""
    scans = [row.message.ranges[0] for row in from_course(run, "/scan", what="scans")]
    sent = [row.message.data for row in run.messages("/distance")]
    # The first scans may be sent before the node is there; a scan in the end may be unanswered.
    scans = scans[next((n for n, first in enumerate(scans[:6]) if same(sent[0], first, 1e-9)), 0) :]
    if not len(scans) - 2 <= len(sent) <= len(scans):
        hint = "Publish in the callback of /scan, each time it is called."
        raise Missed(f"{len(scans)} messages on /distance", f"{len(sent)}", hint)
    # Too near and too far a ray is inf: what comes of that is not judged.
    seen = list(itertools.takewhile(math.isfinite, scans))
    for number, (saw, expected) in enumerate(zip(sent, _filtered(seen, gap.drawn.weight), strict=False), 1):
        if not same(saw, expected, CLOSE):
            expectation = f"{expected:.3f} m as number {number} on /distance"
            raise Missed(expectation, f"{saw:.3f} m", about=(sent[: len(seen)], scans))


@gap.check(4, after=publishes_both, hints={
    SIGN: lambda run: _drives_the_wrong_way(run),
    WIND_UP: lambda run: _speed_on_arrival(run) > 0.9 * MOST,
    "The error is the distance minus 0.6 m: it is 0 where the robot has to stop, not at the wall.":
        lambda run: True,
})
def does_not_run_into_the_wall(run: Recording) -> None:
    """The robot gets within 0.85 m of the wall, and never closer than 0.48 m. It touches nothing."""
    keeps_clear(run, "")
    distances, drawn = _distances(run, 0.0), gap.drawn
    nearest, stamp = min(distances)
    last, _ = distances[-1]
    if last > drawn.comes:
        raise Missed(f"{drawn.comes} m or less to the wall at the end", f"{last:.2f} m", SIGN, picture="path")
    if nearest < drawn.least:
        saw = f"{nearest:.2f} m at {stamp:.3g} s"
        raise Missed(f"{drawn.least} m or more to the wall", saw, picture="path")


@gap.check(2, after=does_not_run_into_the_wall)
def keeps_within_the_limit(run: Recording) -> None:
    """The speed never exceeds 0.3 m/s, in either direction."""
    with hinting(f"Clip it before you publish it: max(-{MOST:g}, min({MOST:g}, speed))."):
        within(run, "/speed", "data", -MOST, MOST, unit="m/s")


@gap.check(4, after=does_not_run_into_the_wall, hints={
    "P alone stops where its command just balances the slope. I removes the remaining error: add the sum "
    "of error times time.": lambda run, distance: distance > gap.drawn.target,
    WIND_UP: otherwise,
})
def stands_at_the_distance(run: Recording) -> None:
    """For the last four seconds it stands 0.6 m from the wall, within 3 cm."""
    begin, target = run.ended.stamp - LAST, gap.drawn.target
    speeds = Window(begin, run.ended.stamp).rows(run.messages("/speed"))
    held = sum(math.isfinite(row.message.data) for row in speeds)
    if held < HELD * LAST / PERIOD:
        hint = ("A node that publishes nothing leaves the job to the brake: publish a speed for every scan, "
                "to the end.")
        raise Missed(f"a speed with each scan in the last {LAST:g} s", f"{held} of them", hint)
    worst, _ = max(_distances(run, begin), key=lambda row: abs(row[0] - target))
    if not is_near(worst, target, NEAR):
        expected = f"{target} m, within {NEAR * 100:g} cm"
        raise Missed(expected, f"{worst:.2f} m", about=(worst,), picture="path")


def _distances(run: Recording, begin: Seconds) -> list[tuple[float, Seconds]]:
    """Return how far (m) the wall was ahead of the robot from a stamp on, and when."""
    wall = world_in(run).bounds[2]
    return [(wall - pose.x, pose.stamp) for pose in run.path if pose.stamp >= begin - EDGE]


def _drives_the_wrong_way(run: Recording) -> bool:
    """Return whether the first speeds have another sign than the errors of the distances beside them."""
    pairs = zip(run.messages("/distance")[:20], run.messages("/speed")[:20], strict=False)
    target = gap.drawn.target
    return sum(bool((row.message.data - target) * speed.message.data < 0) for row, speed in pairs) > 10


def _speed_on_arrival(run: Recording) -> float:
    """The last speed before the robot was nearer than it should."""
    target = gap.drawn.target
    passed = next((stamp for distance, stamp in _distances(run, 0.0) if distance < target), math.inf)
    last = last_before(run.messages("/speed"), passed)
    return float(last.message.data) if last else 0.0


def _filtered(values: list[float], weight: float) -> list[float]:
    """Values after a low-pass filter of first order that begins with the first of them."""
    return list(itertools.accumulate(values, lambda before, value: before + weight * (value - before)))
