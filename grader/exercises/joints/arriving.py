"""An exercise on feedback: go on when the joint has arrived, and not when some time has passed."""

from __future__ import annotations

import itertools
from typing import NamedTuple

from grader.checks import Missed, publishes, tip_at, tip_path
from grader.exercise import Exercise
from grader.exercises.joints.crew import foreman
from grader.exercises.joints.places import joint_of
from sim.evidence import Recording, Seconds

FLOAT, COMMANDS = "std_msgs/msg/Float64", "/joint_commands"
CLOSE, STANDS = 0.03, 0.1  # rad, rad/s
SOON = 0.6  # s
UNEVEN = 1.0  # s: who looks at the joint is late by about the same each time

arrive = Exercise("arrive", "Wait for arrival", world=joint_of, seconds=18, companions=foreman, seeds=(1, 2))


class Order(NamedTuple):
    """A position that the joint was told."""

    stamp: Seconds
    position: float


@arrive.check(2)
def publishes_commands(run: Recording) -> None:
    """The node publishes Float64 messages on /joint_commands."""
    publishes(run, COMMANDS, FLOAT)


@arrive.check(2, after=publishes_commands)
def begins_with_the_first(run: Recording) -> list[Order]:
    """The first command is the first position of /positions."""
    orders, wanted = _orders(run), _wanted(run)
    if abs(orders[0].position - wanted[0]) > 1e-6:
        raise Missed(
            f"{wanted[0]:g} first", f"{orders[0].position:g}", _why_other(orders[0].position, wanted)
        )
    return orders


@arrive.check(6, after=begins_with_the_first)
def waits_for_arrival(run: Recording, orders: list[Order]) -> list[Order]:
    """No command comes before the joint stands where the one before has sent it."""
    for before, after in itertools.pairwise(orders):
        gap, speed = abs(tip_at(run, after.stamp).yaw - before.position), _speed(run, after.stamp)
        if gap > CLOSE or speed > STANDS:
            raise Missed(
                f"the joint standing at {before.position:g} rad when the next command comes "
                f"({after.stamp:.3g} s)",
                f"{gap:.2f} rad left to go, at {speed:.2f} rad/s",
                _why_early(orders, gap),
                picture="path",
            )
    _is_no_matter_of_time(run, orders)
    share = (len(orders) - 1) / (len(_wanted(run)) - 1)
    if share < 1.0:
        saw = "one command, and no other" if len(orders) == 1 else f"{len(orders)} of them"
        hint = _why_not_all(orders, [one.position for one in orders], _wanted(run))
        raise Missed(
            f"a command for each of {len(_wanted(run))} positions", saw, hint, credit=share, measured=orders
        )
    return orders


@arrive.check(3, after=waits_for_arrival)
def goes_to_all(run: Recording, orders: list[Order]) -> list[Order]:
    """The joint is sent to all of the positions, in their order, each of them once."""
    wanted, told = _wanted(run), [one.position for one in orders]
    if len(told) != len(wanted) or any(abs(a - b) > 1e-6 for a, b in zip(told, wanted, strict=True)):
        raise Missed(_listed(wanted), _listed(told), _why_not_all(orders, told, wanted))
    return orders


@arrive.check(3, after=goes_to_all)
def wastes_no_time(run: Recording, orders: list[Order]) -> None:
    """Each command comes within 0.6 s of the joint's arrival."""
    for before, after in itertools.pairwise(orders):
        came = _arrival(run, before, after.stamp)
        if after.stamp - came > SOON:
            raise Missed(
                f"the next command within {SOON:g} s of the arrival at {before.position:g} rad "
                f"({came:.3g} s)",
                f"{after.stamp - came:.2g} s later",
                "Look at each message on /joint_states: as soon as the joint has arrived, send the next one.",
            )


def _is_no_matter_of_time(run: Recording, orders: list[Order]) -> None:
    """Raises Missed where the joint was always there when a command came, and nobody had looked."""
    pairs = itertools.pairwise(orders)
    waits = [after.stamp - _arrival(run, before, after.stamp) for before, after in pairs]
    if waits and max(waits) - min(waits) > UNEVEN:
        raise Missed(
            "the next command because the joint has arrived",
            f"it once {min(waits):.2g} s after that, and once {max(waits):.2g} s",
            "No way takes longer than that, and most take less: time says nothing about arrival. Compare the "
            "position on /joint_states with the target.",
            picture="path",
        )


def _wanted(run: Recording) -> list[float]:
    return list(next(one for one in run.messages("/positions") if one.from_course).message.data)


def _orders(run: Recording) -> list[Order]:
    """The commands; the same again and again counts once."""
    found: list[Order] = []
    for heard in run.messages(COMMANDS):
        if not found or heard.message.data != found[-1].position:
            found.append(Order(heard.stamp, heard.message.data))
    return found


def _speed(run: Recording, stamp: Seconds) -> float:
    before, now = tip_at(run, stamp - 0.05), tip_at(run, stamp)
    return abs(now.yaw - before.yaw) / 0.05


def _arrival(run: Recording, order: Order, end: Seconds) -> Seconds:
    """When the joint had come to stand at the order's position; the end if it hadn't."""
    for pose in tip_path(run):
        there = order.stamp <= pose.stamp <= end and abs(pose.yaw - order.position) < CLOSE
        if there and _speed(run, pose.stamp) < STANDS:
            return pose.stamp
    return end


def _listed(values: list[float]) -> str:
    return ", ".join(f"{value:g}" for value in values[:9]) + (", ..." if len(values) > 9 else "")


def _why_other(sent: float, wanted: list[float]) -> str:
    if abs(sent) > 3.2:
        return "The positions are radians already, and /joint_commands wants radians."
    if any(abs(sent - other) < 1e-6 for other in wanted[1:]):
        return "Begin with the first: self.positions.pop(0) gives it, and pop() the last."
    return "Publish the numbers of /positions as they are; they come once, latched."


def _why_early(orders: list[Order], gap: float) -> str:
    """The usual reasons for a command that comes too soon."""
    gaps = [after.stamp - before.stamp for before, after in itertools.pairwise(orders)]
    if max(gaps) - min(gaps) < 1e-3 and len(gaps) > 1 and gaps[0] > 0.2:
        return (
            f"A command every {gaps[0]:.3g} s, whatever the joint does: time says nothing about arrival. "
            "Compare its position on /joint_states with the target."
        )
    if gap <= CLOSE:
        return "It is there, but it still moves: arrived means that the velocity is nearly 0, too."
    return (
        "Arrived means abs(position - target) < 0.01, with abs, or any position below the target would do; "
        "and abs(velocity) < 0.01 as well, which alone is true before the joint has begun to move."
    )


def _why_not_all(orders: list[Order], told: list[float], wanted: list[float]) -> str:
    """The usual reasons for another list."""
    if 1 < len(told) < len(wanted):
        last = orders[-1].stamp
        return (
            f"The time is over before all had their turn, the last one at {last:.3g} s: don't wait so long."
        )
    if len(told) < len(wanted):
        return (
            "It never counts as arrived. Compare the position, in radians, with the target, with a tolerance "
            "such as 0.01 rad, and not with ==."
        )
    if len(told) == len(wanted):
        return "Take them in their order, from the front: self.positions.pop(0)."
    return "After the last one there is nothing more to send."
