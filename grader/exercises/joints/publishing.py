"""The first exercise on joints: the publisher of seven positions that ends by itself."""

from __future__ import annotations

import itertools

from grader.checks import Missed, hinting, publishes
from grader.exercise import Exercise
from sim.evidence import Recording

FLOAT, COMMANDS = "std_msgs/msg/Float64", "/joint_commands"
POSITIONS = [0.0, 0.5, -0.5, 0.0, 1.0, -1.0, 0.0]  # rad
PERIOD = 2.0  # s
DEGREES = "Joints are told radians: a right angle is 1.57. Publish the numbers of the task as they are."

seven = Exercise("seven", "Seven positions", world="joint", seconds=20, may_end=True)


@seven.check(2)
def publishes_commands(run: Recording) -> None:
    """The node publishes Float64 messages on /joint_commands."""
    publishes(run, COMMANDS, FLOAT)


@seven.check(4, after=publishes_commands)
def sends_all_seven(run: Recording) -> None:
    """It sends the seven positions, one after the other, and no others."""
    sent = [round(heard.message.data, 6) for heard in run.messages(COMMANDS)]
    if sent != POSITIONS:
        raise Missed(_listed(POSITIONS), _listed(sent), _why_others(sent))


@seven.check(3, after=sends_all_seven)
def every_two_seconds(run: Recording) -> None:
    """The first one comes at 2 s, and then one every 2 s."""
    stamps = [heard.stamp for heard in run.messages(COMMANDS)]
    gaps = [after - before for before, after in itertools.pairwise([0.0, *stamps])]
    index = next((index for index, gap in enumerate(gaps) if abs(gap - PERIOD) > 0.05), None)
    if index is not None:
        raise Missed(
            f"position {index + 1} at {PERIOD * (index + 1):g} s",
            f"it at {stamps[index]:.3g} s",
            "One timer with a period of 2.0 s calls send(), and each call publishes one position.",
        )


@seven.check(3, after=sends_all_seven)
def ends_by_itself(run: Recording) -> None:
    """When all are sent it ends: its node is gone, ROS is shut down, and there is no error."""
    last = run.messages(COMMANDS)[-1].stamp
    if run.errors:
        raise Missed("an end without an error", f"{run.errors[0].type}{run.errors[0].says}")
    if run.all_exited_at is None or run.all_exited_at > last + PERIOD + 0.1:
        with hinting(
            "When there is no position left: self.destroy_node(), and then rclpy.shutdown(). After that "
            "rclpy.spin() returns, and main() comes to its end."
        ):
            raise Missed(
                f"the program at its end, at most {PERIOD:g} s after the last position (at {last:.3g} s)",
                f"it still running at {run.ended.stamp:.3g} s"
                if run.all_exited_at is None
                else f"{run.all_exited_at:.3g} s",
            )


def _listed(values: list[float]) -> str:
    shown = ", ".join(f"{value:g}" for value in values[:9])
    return f"{shown}, and {len(values) - 9} more" if len(values) > 9 else shown


def _why_others(sent: list[float]) -> str:
    """The usual reasons for other positions."""
    if any(abs(value) > 3.2 for value in sent):
        return DEGREES
    if sent == POSITIONS[1:] or sent == POSITIONS[:-1]:
        which = "first" if sent == POSITIONS[1:] else "last"
        return f"The {which} one is missing. Publish first, and then add 1 to self.index."
    if sent[: len(POSITIONS)] == POSITIONS:
        return "After the seventh it is over: compare self.index with len(self.positions)."
    if len(set(sent)) == 1:
        return "Each call sends the same one: self.positions[self.index], and then self.index += 1."
    return "Publish self.positions[self.index], and then self.index += 1."
