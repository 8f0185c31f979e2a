"""Refuse requests beyond a lift's limits, notice when the lift is stuck, and carry on."""

import itertools
import math
from typing import Any, NamedTuple

from grader.checks import Missed, answers, commands_within, otherwise, publishes
from grader.checks.joints import JointLimits, described_limits
from grader.exercise import Exercise
from grader.exercises.joints.careful.lift import JOINT, lift
from grader.geometry.near import is_near
from grader.responses import Stimuli, Stimulus, Window, from_course, last_before, same
from sim.evidence import Message, Recording, Seconds
from sim.world.machines.urdf import EFFORT

__all__ = ["careful", "lift"]

COMMANDS, WANTED = "/joint_commands", "/wanted"
SOON, REACTION, PEAK = 0.3, 1.2, 0.35  # s
NEAR, STANDS = 0.05, 0.01  # rad, rad/s

careful = Exercise("careful", "A lift that gets stuck", seconds=23, companions=lift, seeds=(1, 2))
requests = Stimuli(WANTED, answered_on=COMMANDS, within=SOON, what="good and bad requests")


class Jam(NamedTuple):
    """A jam: when and where the lift got stuck, and the effort (N m) with which it pulls."""

    stamp: Seconds
    position: float  # rad
    effort: float


@careful.check(2)
def publishes_commands(run: Recording) -> None:
    """The node publishes Float64 messages on /joint_commands."""
    publishes(run, COMMANDS, "std_msgs/msg/Float64")


@careful.check(4, after=publishes_commands, hints={
    "Positions and limits are all in radians: pass the number on unchanged.":
        lambda run, request: request.responses and not is_near(request.values()[0], 0.0, 3.2),
    "A refusal isn't the end: return from the callback, and handle the next request as usual.":
        lambda run, request: _silent_since_a_refusal(run, request),
    "A limit itself is within the limits: compare with <=, not with <.":
        lambda run, request: all(
            (other.value.data in _limits(run)) != bool(other.responses)
            for other in requests(run, where=lambda msg: _is_within(run, msg))
        ),
    "It is between the limits, {lower:g} and {upper:g} rad. Read both from the description.":
        lambda run, request: _limits(run)._asdict(),
})
def passes_on(run: Recording) -> None:
    """Every position within the lift's limits is passed on to /joint_commands at once."""
    _refused(run)
    for request in requests(run, where=lambda msg: _is_within(run, msg)):
        request.expects(request.value.data)


@careful.check(4, after=passes_on, hints={
    "nan is neither below the lower limit nor above the upper one: every comparison with it is False. Test "
    "the other way round: if not lower <= value <= upper, refuse.": lambda run: all(
        math.isnan(row.message.data) for row in run.messages(COMMANDS) if not _is_within(run, row.message)
    ),
    "Before you publish, compare with both limits from the description, the lower one with its sign.":
        lambda run: True,
})
def refuses(run: Recording) -> None:
    """A position beyond the limits, or nan, is not passed on, and nothing is sent in its place."""
    commands_within(run, COMMANDS, "data", *_limits(run))
    for request in _refused(run):
        if request.responses and not _holds_a_jam(run, request.responses[0], REACTION + SOON):
            request.expects_nothing(
                f"no command after the request for {request.value.data:g} at {request.stamp:.3g} s",
                "Refusing isn't clipping: the sender must learn that the request won't be carried "
                "out. Send nothing, and log a warning.",
            )


@careful.check(2, after=refuses, guess="Where you refuse, add: self.get_logger().warning(...).")
def logs_refusals(run: Recording) -> None:
    """Each refusal is logged as a warning."""
    answers(
        run, WANTED, level="WARN", within=SOON, where=lambda row: not _is_within(run, row.message),
        what="positions that can't be reached",
    )


@careful.check(5, after=passes_on, hints={
    "Whenever it starts to move, it pulls with its full effort for a moment. A joint is stuck only "
    "when it has done so for half a second without moving.": lambda run, jam, later: jam is None,
    "Here it pulls the other way, so its effort is negative: compare abs(effort) with the limit.":
        lambda run, jam, later: jam.effort < 0 and any(other.effort > 0 and _is_freed(run, other)
                                                       for other in _jams(run)),
    "That is late: half a second of pulling without moving is enough to know.":
        lambda run, jam, later: later and same(later[0], jam.position, NEAR),
    "The lift isn't stuck at {sent:.2g}. Send the position that the message has for lift_joint: find its "
    "index in msg.name, and use that index for position, velocity and effort.":
        lambda run, jam, later: later and {"sent": later[0]},
    "The lift is stuck when abs(effort) is as high as the description's limit and abs(velocity) is below "
    "0.01 rad/s, for half a second: a measured velocity is hardly ever exactly 0. Read both by the joint's "
    "name, store since when, and compare with now.": otherwise,
})
def frees_what_is_stuck(run: Recording) -> None:
    """A lift that is stuck is commanded to stay where it is, within 1.2 s, and at no other time."""
    for jam in _jams(run):
        if not _is_freed(run, jam):
            sent = Window.after(jam.stamp, REACTION).rows(run.messages(COMMANDS))
            later = [row for row in run.messages(COMMANDS) if row.stamp >= jam.stamp]
            where = f"{jam.position:.2f}, where it is stuck, on {COMMANDS} within {REACTION:g} s of"
            saw = ", ".join(f"{row.message.data:.3g}" for row in sent[:5]) or "nothing"
            others = [row.message.data for row in later if not _is_requested(run, row)]
            raise Missed(f"{where} {jam.stamp:.3g} s", saw, about=(jam, others))
    in_place_of_refusals = [row for request in _refused(run) for row in request.responses]
    for row in run.messages(COMMANDS):
        is_right = row in in_place_of_refusals or _is_requested(run, row)
        if not is_right and not _holds_a_jam(run, row, REACTION + SOON):
            expected = "commands only for valid requests, and when the lift is stuck"
            raise Missed(expected, f"{row.message.data:.3g} at {row.stamp:.3g} s", about=(None, []))


def _limits(run: Recording) -> JointLimits:
    return described_limits(run)[JOINT]


def _is_within(run: Recording, message: Any) -> bool:
    return _limits(run).margin(message.data) >= 0


def _refused(run: Recording) -> list[Stimulus]:
    return requests(run, where=lambda msg: not _is_within(run, msg))


def _silent_since_a_refusal(run: Recording, request: Stimulus) -> bool:
    refused = [other.stamp for other in _refused(run) if other.stamp < request.stamp]
    return bool(refused) and not any(row.stamp > refused[0] for row in run.messages(COMMANDS))


def _is_requested(run: Recording, command: Message) -> bool:
    last = last_before(run.messages(WANTED), command.stamp)
    return last is not None and same(command.message.data, last.message.data)


def _jams(run: Recording) -> list[Jam]:
    """Return when and where the lift got stuck: it pulls for longer than when it begins to move."""
    found = []
    for pulling, group in itertools.groupby(_states(run), key=lambda state: state[1]):
        rows = [jam for jam, _ in group]
        if pulling and rows[-1].stamp - rows[0].stamp > PEAK and rows[0].stamp < run.ended.stamp - REACTION:
            found.append(rows[0])
    return found


def _states(run: Recording) -> list[tuple[Jam, bool]]:
    """Each state of the lift, and whether it pulls with full effort and does not move."""
    found = []
    for row in from_course(run, "/joint_states"):
        index = list(row.message.name).index(JOINT)
        effort, velocity = row.message.effort[index], row.message.velocity[index]
        pulling = abs(effort) == EFFORT and abs(velocity) < STANDS
        found.append((Jam(row.stamp, row.message.position[index], effort), pulling))
    return found


def _is_freed(run: Recording, jam: Jam) -> bool:
    """Return whether the lift gets a command in time to stay where it is stuck."""
    sent = Window.after(jam.stamp, REACTION).rows(run.messages(COMMANDS))
    return any(same(row.message.data, jam.position, NEAR) for row in sent)


def _holds_a_jam(run: Recording, command: Message, within: Seconds) -> bool:
    """Return whether a command keeps the lift where it was stuck."""
    jams = [jam for jam in _jams(run) if Window.after(jam.stamp, within).contains(command.stamp)]
    return any(same(command.message.data, jam.position, NEAR) for jam in jams)
