"""Refuse requests beyond a lift's limits, notice when the lift is stuck, and carry on."""

import itertools
import math
from typing import Any, NamedTuple

from grader.checks import Missed, answers, commands_within, otherwise, publishes
from grader.checks.joints import JointLimits, described_limits
from grader.companions.lift import JOINT, lift
from grader.exercise import Exercise
from grader.responses import Stimuli, Stimulus, Window, from_course, last_before, same
from sim.evidence import Message, Recording, Seconds
from sim.world.machines.urdf import EFFORT

COMMANDS, WANTED = "/joint_commands", "/wanted"
SOON, REACTION, PEAK = 0.3, 1.2, 0.35  # s
NEAR = 0.05  # rad

careful = Exercise("careful", "A lift that gets stuck", seconds=23, companions=lift, seeds=(1, 2))
requests = Stimuli(WANTED, answered_on=COMMANDS, within=SOON, what="good and bad requests")


class Jam(NamedTuple):
    """When and where the lift got stuck, and the effort (N m) with which it pulls."""

    stamp: Seconds
    position: float  # rad
    effort: float


@careful.check(2)
def publishes_commands(run: Recording) -> None:
    """The node publishes Float64 messages on /joint_commands."""
    publishes(run, COMMANDS, "std_msgs/msg/Float64")


@careful.check(4, after=publishes_commands, hints={
    "Positions and limits are radians, all of them: pass the number on as it is.":
        lambda run, request: request.responses and abs(request.values()[0]) > 3.2,
    "A refusal is not the end: return from the callback, and take the next request as ever.":
        lambda run, request: _silent_since_a_refusal(run, request),
    "It lies between the limits, {lower:g} and {upper:g} rad. Read both from the description.":
        lambda run, request: _limits(run)._asdict(),
})
def passes_on(run: Recording) -> None:
    """Every position within the lift's limits is passed on to /joint_commands at once."""
    _refused(run)
    for request in requests(run, where=lambda msg: _is_within(run, msg)):
        request.expects(request.value.data)


@careful.check(4, after=passes_on, hints={
    "nan is neither below the lower limit nor above the upper one: each comparison with it is False. Ask "
    "the other way round: if not lower <= value <= upper, refuse.": lambda run: all(
        math.isnan(row.message.data) for row in run.messages(COMMANDS) if not _is_within(run, row.message)
    ),
    "Compare with both limits of the description before you publish, the lower one with its sign.":
        lambda run: True,
})
def refuses(run: Recording) -> None:
    """A position beyond the limits, or nan, is not passed on, nor anything else in its place."""
    commands_within(run, COMMANDS, "data", *_limits(run))
    for request in _refused(run):
        if request.responses and not _holds_a_jam(run, request.responses[0], REACTION + SOON):
            request.expects_nothing(
                f"no command after {request.value.data:g} is wanted, at {request.stamp:.3g} s",
                "Refusing isn't clipping: the sender must learn that the request won't be done. "
                "Send nothing, and log it.",
            )


@careful.check(2, after=refuses, guess="Where you refuse: self.get_logger().warning(...).")
def logs_refusals(run: Recording) -> None:
    """Each refusal is logged as a warning."""
    answers(
        run, WANTED, level="WARN", within=SOON, where=lambda row: not _is_within(run, row.message),
        what="positions that can't be gone to",
    )


@careful.check(5, after=passes_on, hints={
    "For a moment it pulls with all its might whenever it begins to move. Stuck is a joint that has "
    "pulled so for half a second, and didn't move.": lambda run, jam, later: jam is None,
    "Here it pulls the other way, and its effort is below 0: compare abs(effort) with the limit.":
        lambda run, jam, later: jam.effort < 0 and any(other.effort > 0 and _is_freed(run, other)
                                                       for other in _jams(run)),
    "That is late: half a second of pulling without a movement is enough to know.":
        lambda run, jam, later: later and same(later[0], jam.position, NEAR),
    "It isn't {sent:.2g} where it is stuck. Send the position that the message has for lift_joint: find "
    "its place in msg.name, and take position, velocity and effort from there.":
        lambda run, jam, later: later and {"sent": later[0]},
    "Stuck is when abs(effort) is as high as the description's limit, and abs(velocity) is 0, for half a "
    "second. Read them by the joint's name, remember since when, and compare with now.": otherwise,
})
def frees_what_is_stuck(run: Recording) -> None:
    """A lift that is stuck is commanded to stay where it is, within 1.2 s; and at no other time."""
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
            expected = "commands only for what is wanted, and where the lift is stuck"
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
    """When and where the lift got stuck: it pulls for longer than when it begins to move."""
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
        pulling = abs(effort) >= EFFORT and abs(velocity) < 1e-6
        found.append((Jam(row.stamp, row.message.position[index], effort), pulling))
    return found


def _is_freed(run: Recording, jam: Jam) -> bool:
    """Whether the lift gets a command in time to stay where it is stuck."""
    sent = Window.after(jam.stamp, REACTION).rows(run.messages(COMMANDS))
    return any(same(row.message.data, jam.position, NEAR) for row in sent)


def _holds_a_jam(run: Recording, command: Message, within: Seconds) -> bool:
    """Whether a command keeps the lift where it was stuck."""
    jams = [jam for jam in _jams(run) if Window.after(jam.stamp, within).contains(command.stamp)]
    return any(same(command.message.data, jam.position, NEAR) for jam in jams)
