"""Publish seven positions for a joint, one every two seconds, and end."""

import itertools
import math

from grader.checks import Missed, otherwise, publishes
from grader.exercise import Exercise
from grader.geometry.near import is_near
from grader.responses import listed
from grader.variants import Variants
from sim.evidence import Recording

COMMANDS = "/joint_commands"
NEARLY = 0.25  # of the points
HELD = 0.5  # s: as long as no callback takes

seven = Exercise("seven", "Seven positions", world="joint", seconds=20, may_end=True, variants=Variants(
    {"positions": ("0.0, 0.5, -0.5, 0.0, 1.0, -1.0, 0.0", "0.0, 0.4, -0.4, 0.0, 0.8, -0.8, 0.0",
                   "0.0, -0.3, 0.3, 0.0, -0.9, 0.9, 0.0")},  # rad
    {"period": (2.0, 1.5), "seconds": ("two", "1.5")},
    texts=("self.positions = [{positions}]", "Every **{period:g} s**", "comes at {period:g}",
           "every {period:g} s", "create_timer({period}, "),
    elsewhere=("every {seconds} seconds",),
))


@seven.check(2)
def publishes_commands(run: Recording) -> None:
    """The node publishes Float64 messages on /joint_commands."""
    publishes(run, COMMANDS, "std_msgs/msg/Float64")


@seven.check(4, after=publishes_commands, hints={
    "Joints are commanded in radians: a right angle is 1.57. Publish the numbers from the task unchanged.":
        lambda run, sent: any(not is_near(value, 0.0, 3.2) for value in sent),
    "The {which} one is missing. Publish first, and then add 1 to self.index.": lambda run, sent: (
        (sent == _positions()[1:] and {"which": "first"}) or (sent == _positions()[:-1] and {"which": "last"})
    ),
    "Stop after the seventh: compare self.index with len(self.positions).":
        lambda run, sent: sent[: len(_positions())] == _positions(),
    "Each call sends the same one: publish self.positions[self.index], and then self.index += 1.":
        lambda run, sent: len(set(sent)) == 1,
    "Publish self.positions[self.index], and then self.index += 1.": otherwise,
})
def sends_all_seven(run: Recording) -> None:
    """It sends the seven positions, one after the other, and no others."""
    sent = [round(row.message.data, 6) for row in run.messages(COMMANDS)]
    if sent != _positions():
        credit = NEARLY * _is_nearly_right(sent)
        raise Missed(listed(_positions()), listed(sent), about=(sent,), credit=credit)


def _positions() -> list[float]:
    return [float(number) for number in seven.drawn.positions.split(", ")]


def _is_nearly_right(sent: list[float]) -> bool:
    """Return whether one mistake explains what was sent: the order, unit, one too few, or a late end."""
    positions = _positions()
    in_degrees = [round(math.degrees(value), 6) for value in positions]
    parts = positions, positions[1:], positions[:-1], in_degrees
    return sent[: len(positions)] == positions or sorted(sent) in map(sorted, parts)


@seven.check(3, after=sends_all_seven)
def every_two_seconds(run: Recording) -> None:
    """The first one comes at 2 s, and then one every 2 s."""
    own = [row for row in run.callbacks if row.node not in run.course_nodes]
    held = max((row.duration for row in own), default=0.0)
    if held > HELD:
        hint = ("The timer calls send() again and again: publish one position, and return. While a callback "
                "sleeps, its node receives nothing, not even a stop.")
        raise Missed("a callback that returns at once", f"one that blocked the node for {held:.3g} s", hint)
    stamps, period = [row.stamp for row in run.messages(COMMANDS)], seven.drawn.period
    for number, (before, stamp) in enumerate(itertools.pairwise([run.started_at, *stamps]), start=1):
        if not is_near(stamp - before, period, 0.05):
            hint = (f"Let one timer with a period of {period} s call send(), and publish one position in "
                    "each call.")
            raise Missed(f"position {number} at {period * number:g} s", f"it at {stamp:.3g} s", hint)


@seven.check(3, after=sends_all_seven)
def ends_by_itself(run: Recording) -> None:
    """When all are sent, the program ends: its node is destroyed, ROS is shut down, and there is no error."""
    last, end, period = run.messages(COMMANDS)[-1].stamp, run.all_exited_at, seven.drawn.period
    if run.errors:
        raise Missed("an end without an error", f"{run.errors[0].type}{run.errors[0].says}")
    if end is None or end > last + period + 0.1:
        expected = f"the program to end, at most {period:g} s after the last position (at {last:.3g} s)"
        saw = f"the program still running at {run.ended.stamp:.3g} s" if end is None else f"{end:.3g} s"
        hint = ("When there is no position left: self.destroy_node(), and then rclpy.shutdown(). After that "
                "rclpy.spin() returns, and main() ends.")
        raise Missed(expected, saw, hint)
