"""Send a joint to the next position when it has arrived, and not when some time has passed."""

import itertools

from grader.checks import Missed, otherwise, publishes, tip_at, tip_path
from grader.companions.joint_targets import foreman
from grader.exercise import Exercise
from grader.geometry.near import is_near
from grader.responses import Window, from_course, listed, matches, same
from grader.worlds.arms import joint_of
from sim.evidence import Message, Recording, Seconds

COMMANDS, STATES = "/joint_commands", "/joint_states"
CLOSE, STANDS = 0.03, 0.1  # rad, rad/s
SOON = 0.6  # s
UNEVEN = 1.0  # s: a node that looks at the joint is late by about the same each time

arrive = Exercise("arrive", "Wait for arrival", world=joint_of, seconds=18, companions=foreman, seeds=(1, 2))

NOT_ALL = {
    "The time ran out before all were sent, the last one at {last:.3g} s: don't wait so long.":
        lambda run, sent: 1 < len(sent) < len(_positions(run)) and {"last": _commands(run)[-1].stamp},
    "Your code never sees the joint arrive. Compare the position with the target, both in radians, with a "
    "tolerance such as 0.01 rad, not with ==.": lambda run, sent: len(sent) < len(_positions(run)),
    "Take them in order, from the front: self.positions.pop(0).":
        lambda run, sent: len(sent) == len(_positions(run)),
    "After the last one, send nothing more.": otherwise,
}


@arrive.check(2)
def publishes_commands(run: Recording) -> None:
    """The node publishes Float64 messages on /joint_commands."""
    publishes(run, COMMANDS, "std_msgs/msg/Float64")


@arrive.check(2, after=publishes_commands, hints={
    "The positions are already in radians, and so is /joint_commands: don't convert.":
        lambda run, first: not is_near(first, 0.0, 3.2),
    "Begin with the first: self.positions.pop(0) returns it, but pop() returns the last.":
        lambda run, first: any(same(first, other) for other in _positions(run)[1:]),
    "Publish the numbers from /positions unchanged; they are sent once, latched.": otherwise,
})
def begins_with_the_first(run: Recording) -> None:
    """The first command is the first position of /positions."""
    first, expected = _commands(run)[0].message.data, _positions(run)[0]
    if not same(first, expected):
        raise Missed(f"{expected:g} first", f"{first:g}", about=(first,))


@arrive.check(6, after=begins_with_the_first, hints={
    "You send a command every {period:.3g} s, whatever the joint does: time doesn't tell you that it "
    "has arrived. Compare its position on /joint_states with the "
    "target.": lambda run, commands, gap: _period(commands),
    "It is there, but still moving: arrived also means that the velocity is nearly 0.":
        lambda run, commands, gap: gap <= CLOSE,
    "Arrived means abs(position - target) < 0.01 (without abs, any position below the target would do) "
    "and abs(velocity) < 0.01 (which alone is true before the joint starts to move).":
        lambda run, commands, gap: True,
    **NOT_ALL,
})
def waits_for_arrival(run: Recording) -> None:
    """No command comes before the joint has stopped at the previous position."""
    commands, count = _commands(run), len(_positions(run))
    for before, after in itertools.pairwise(commands):
        target = before.message.data
        gap, speed = abs(tip_at(run, after.stamp).yaw - target), _speed(run, after.stamp)
        if gap > CLOSE or speed > STANDS:
            when = f"when the next command comes ({after.stamp:.3g} s)"
            saw = f"{gap:.2f} rad left to go, at {speed:.2f} rad/s"
            expected = f"the joint standing still at {target:g} rad {when}"
            raise Missed(expected, saw, about=(commands, gap), picture="path")
    _does_not_count_time(run, commands)
    share = (len(commands) - 1) / (count - 1)
    if share < 1.0:
        saw = "one command, and no other" if len(commands) == 1 else f"{len(commands)} of them"
        sent = [row.message.data for row in commands]
        raise Missed(f"a command for each of {count} positions", saw, about=(sent,), credit=share)


@arrive.check(3, after=waits_for_arrival, hints=NOT_ALL)
def goes_to_all(run: Recording) -> None:
    """The joint is sent to all of the positions, in order, once each."""
    positions, sent = _positions(run), [row.message.data for row in _commands(run)]
    if len(sent) != len(positions) or not matches(sent, positions):
        raise Missed(listed(positions), listed(sent), about=(sent,))


@arrive.check(3, after=goes_to_all)
def wastes_no_time(run: Recording) -> None:
    """Each command comes within 0.6 s of the joint's arrival."""
    for before, after in itertools.pairwise(_commands(run)):
        arrived = _arrival(run, before, after.stamp)
        if after.stamp - arrived > SOON:
            where = f"the arrival at {before.message.data:g} rad ({arrived:.3g} s)"
            hint = f"Look at each message on {STATES}: as soon as the joint has arrived, send the next one."
            saw = f"{after.stamp - arrived:.2g} s later"
            raise Missed(f"the next command within {SOON:g} s of {where}", saw, hint)


def _positions(run: Recording) -> list[float]:
    return list(from_course(run, "/positions")[0].message.data)


def _commands(run: Recording) -> list[Message]:
    """The commands; the first one of equal ones in a row."""
    rows = itertools.groupby(run.messages(COMMANDS), key=lambda row: row.message.data)
    return [next(equal) for _, equal in rows]


def _does_not_count_time(run: Recording, commands: list[Message]) -> None:
    """Raise Missed where commands come regularly, with pauses that are long enough for each movement."""
    pairs = itertools.pairwise(commands)
    waits = [after.stamp - _arrival(run, before, after.stamp) for before, after in pairs]
    if waits and max(waits) - min(waits) > UNEVEN:
        saw = f"it {min(waits):.2g} s after that one time, and {max(waits):.2g} s another time"
        hint = ("No move takes longer than that, and most take less: time doesn't tell you that it "
                "has arrived. Compare the position on /joint_states with the target.")
        raise Missed("the next command because the joint has arrived", saw, hint, picture="path")


def _period(commands: list[Message]) -> dict[str, Seconds] | None:
    """The time between two commands, where it is always the same."""
    gaps = [after.stamp - before.stamp for before, after in itertools.pairwise(commands)]
    regular = len(gaps) > 1 and max(gaps) - min(gaps) < 1e-3 and gaps[0] > 0.2
    return {"period": gaps[0]} if regular else None


def _speed(run: Recording, stamp: Seconds) -> float:
    return abs(tip_at(run, stamp).yaw - tip_at(run, stamp - 0.05).yaw) / 0.05


def _arrival(run: Recording, command: Message, end: Seconds) -> Seconds:
    """Return when the joint came to stand at a command's position; the end if it did not."""
    for pose in Window(command.stamp, end).rows(tip_path(run)):
        if abs(pose.yaw - command.message.data) < CLOSE and _speed(run, pose.stamp) < STANDS:
            return pose.stamp
    return end
