"""A subscriber that logs where the joints are, in degrees."""

import itertools
import math
import re
from typing import NamedTuple

from grader.checks import Missed, otherwise, subscribes
from grader.companions.joint_targets import NAMES, gymnast
from grader.exercise import Exercise
from grader.responses import Window, from_course
from grader.variants import Variants
from grader.worlds.arms import arm_of
from sim.evidence import Recording, Seconds

LINE = re.compile(rf"({'|'.join(NAMES)})[^\w-]+(-?\d+(?:\.\d+)?)")
RECENT, NEAR = 0.15, 0.11  # s: how old a position may be; degrees
SHORTEST, LONGEST, FIRST = 0.7, 1.3, 2.3  # periods: between two lines about a joint, and until the first

degrees = Exercise("degrees", "Where the joints are", world=arm_of, seconds=10, companions=gymnast,
                   seeds=(1, 2), variants=Variants(
    {"period": (1.0, 0.5), "often": ("once a second", "twice a second"),
     "Often": ("Once a second", "Twice a second"), "every": ("second", "half second"),
     "rate": ("one line", "two lines")},
    texts=("{often}", "{Often}", "each joint every {every}", "asks for {rate} a second",
           "create_timer({period}, self.show)"),
))


class Shown(NamedTuple):
    """A number in a log line that names a joint."""

    stamp: Seconds
    name: str
    number: float


@degrees.check(1)
def subscribes_to_states(run: Recording) -> None:
    """The node subscribes to /joint_states."""
    subscribes(run, "/joint_states", "sensor_msgs/msg/JointState")


@degrees.check(2, after=subscribes_to_states, hints={
    "That is its position in radians: math.degrees(position) gives degrees.":
        lambda run, row: _is_near(run, row.name, math.degrees(row.number), row.stamp),
    "That is the other joint's position. Drivers list their joints in an order of their own: for name, "
    "position in zip(msg.name, msg.position).":
        lambda run, row: any(_is_near(run, name, row.number, row.stamp) for name in {*NAMES} - {row.name}),
    "That was its position some time ago. Store each message that comes, and log the newest.":
        lambda run, row: any(_is_near(run, row.name, row.number, sent.stamp)
                             for sent in run.received("/joint_states") if sent.stamp < row.stamp),
    "Each joint's position is on /joint_states, in radians, by its name.": otherwise,
}, guess="print() writes for you alone; self.get_logger().info(...) is a log line.")
def logs_degrees(run: Recording) -> list[Shown]:
    """Log lines such as “elbow_joint: -28.6 degrees” say where both joints of the arm are."""
    shown = _shown(run)
    for name in NAMES:
        if not any(row.name == name for row in shown):
            hint = ("Log a line for each of the two joints. throttle_duration_sec holds for a line of code: "
                    "of two messages that it logs at the same time, the second is left out.")
            raise Missed(f"log lines like “{name}: 57.3 degrees”", _first_line(run), hint if shown else "")
    for row in shown:
        if not _is_near(run, row.name, row.number, row.stamp):
            recent = [math.degrees(position) for position in _positions(run, row.name, row.stamp)]
            expected = f"{row.name} at {recent[-1]:.1f} degrees" if recent else "no line yet"
            raise Missed(expected, f"“{row.name}: {row.number:g}” at {row.stamp:.3g} s", about=(row,))
    return shown


@degrees.check(1, after=logs_degrees)
def once_a_second(run: Recording, shown: list[Shown]) -> None:
    """There is one line for each joint every second."""
    period, every = degrees.drawn.period, degrees.drawn.every
    for name in NAMES:
        stamps = [row.stamp for row in shown if row.name == name]
        gaps = [(end - begin, begin) for begin, end in itertools.pairwise(stamps)]
        first, last = (stamps[0] - run.started_at, run.started_at), (run.ended.stamp - stamps[-1], stamps[-1])
        wrong = [gap for gap in gaps if not SHORTEST <= gap[0] / period <= LONGEST]
        for seconds, begin in [
                *wrong, *[last] * (last[0] > LONGEST * period), *[first] * (first[0] > FIRST * period)]:
            hint = ("Store what comes in a dictionary, and log what it has in the callback of a timer of "
                    f"{period:g} s.")
            saw = f"{seconds:.2g} s between two, from {begin:.3g} s on"
            raise Missed(f"one line about {name} each {every}", saw, hint)


def _shown(run: Recording) -> list[Shown]:
    lines = [line for line in run.logs if not line.from_course]
    return [Shown(line.stamp, found[1], float(found[2]))
            for line in lines for found in LINE.finditer(line.text)]


def _first_line(run: Recording) -> str:
    return next((f"“{line.text[:60]}”" for line in run.logs if not line.from_course), "no log line")


def _positions(run: Recording, name: str, stamp: Seconds) -> list[float]:
    """The positions (rad) of a joint that came in the last moments before a stamp."""
    rows = Window(stamp - RECENT, stamp).rows(from_course(run, "/joint_states"))
    return [dict(zip(row.message.name, row.message.position, strict=True))[name] for row in rows
            if name in row.message.name]


def _is_near(run: Recording, name: str, number: float, stamp: Seconds) -> bool:
    """Return whether a joint was at this number of degrees, or between two of its positions then."""
    found = [math.degrees(position) for position in _positions(run, name, stamp)]
    return bool(found) and min(found) - NEAR <= number <= max(found) + NEAR
