"""An exercise on errors: refuse what lies beyond the limits, notice a joint that is stuck, and go on."""

from __future__ import annotations

import itertools
import math
from typing import NamedTuple

from grader.checks import Missed, answers, commands_within, publishes
from grader.checks.no_data import no_data
from grader.exercise import Exercise
from grader.exercises.joints.lift import JOINT, lift
from grader.exercises.joints.watching import limits_of
from sim.evidence import Message, Recording, Seconds
from sim.world.machines.urdf import EFFORT

FLOAT, COMMANDS, WANTED = "std_msgs/msg/Float64", "/joint_commands", "/wanted"
SOON, REACTION, PEAK = 0.3, 1.2, 0.35  # s
HERE = 0.05  # rad

careful = Exercise("careful", "A lift that gets stuck", seconds=23, companions=lift, seeds=(1, 2))


class State(NamedTuple):
    """What the lift said of itself."""

    stamp: Seconds
    position: float
    pulling: bool  # with all its might, and doesn't move
    effort: float  # N m


@careful.check(2)
def publishes_commands(run: Recording) -> None:
    """The node publishes Float64 messages on /joint_commands."""
    publishes(run, COMMANDS, FLOAT)


@careful.check(
    4, after=publishes_commands, guess="Publish in the callback of /wanted what is within the limits."
)
def passes_on(run: Recording) -> list[tuple[Message, bool]]:
    """What is wanted within the lift's limits goes on to /joint_commands at once, every time."""
    wishes = _wishes(run)
    for heard, good in wishes:
        value = heard.message.data
        if good and not any(abs(one.message.data - value) < 1e-6 for one in _sent_after(run, heard)):
            raise Missed(
                f"{value:g} on /joint_commands within {SOON:g} s of {heard.stamp:.3g} s",
                _values(_sent_after(run, heard)),
                _why_not_passed(run, heard, wishes),
            )
    return wishes


@careful.check(4, after=passes_on)
def refuses(run: Recording, wishes: list[tuple[Message, bool]]) -> None:
    """What lies beyond the limits, or is not a number, is not passed on, nor anything else in its place."""
    lower, upper = limits_of(run)[JOINT]
    commands_within(run, COMMANDS, "data", lower, upper, _why_beyond(run, lower, upper))
    for heard, good in wishes:
        sent = [] if good else _sent_after(run, heard)
        if sent and not _is_answer(run, sent[0]):
            raise Missed(
                f"no command after {heard.message.data:g} is wanted, at {heard.stamp:.3g} s",
                _values(sent),
                "Refusing is not cutting: whoever wanted something else must hear that it won't be done. "
                "Send nothing, and log it.",
            )


@careful.check(2, after=refuses, guess="Where you refuse: self.get_logger().warning(...).")
def says_so(run: Recording) -> None:
    """Each refusal is logged as a warning."""
    lower, upper = limits_of(run)[JOINT]
    answers(
        run,
        WANTED,
        level="WARN",
        within=SOON,
        where=lambda heard: not lower <= heard.message.data <= upper,
        what="positions that can't be gone to",
    )


@careful.check(5, after=passes_on)
def frees_what_is_stuck(run: Recording) -> None:
    """Where the lift is stuck it is told to stay where it is, within 1.2 s; and at no other time."""
    jams = _jams(run)
    for state in jams:
        sent = [one for one in run.messages(COMMANDS) if state.stamp <= one.stamp < state.stamp + REACTION]
        if not _is_held(run, state):
            raise Missed(
                f"{state.position:.2f}, where it is stuck, on /joint_commands within {REACTION:g} s of "
                f"{state.stamp:.3g} s",
                _values(sent),
                _why_not_freed(run, state),
            )
    for heard in run.messages(COMMANDS):
        refused = any(not good and heard in _sent_after(run, wish) for wish, good in _wishes(run))
        if not (refused or _is_wish(run, heard) or _is_answer(run, heard)):
            raise Missed(
                "commands only for what is wanted, and where the lift is stuck",
                f"{heard.message.data:.3g} at {heard.stamp:.3g} s",
                "For a moment it pulls with all its might whenever it begins to move. Stuck is a joint that "
                "has pulled so for half a second, and didn't move.",
            )


def _wishes(run: Recording) -> list[tuple[Message, bool]]:
    """What was wanted, but for what came as the run ended; and whether it lies within the limits."""
    lower, upper = limits_of(run)[JOINT]
    heard = [one for one in run.messages(WANTED) if one.from_course and one.stamp < run.ended.stamp - SOON]
    found = [(one, lower <= one.message.data <= upper) for one in heard]
    if len({good for _, good in found}) < 2:
        raise no_data(run, "good and bad wishes", f"{len(found)} wishes", run.graph.publishers(WANTED))
    return found


def _sent_after(run: Recording, wish: Message) -> list[Message]:
    return [one for one in run.messages(COMMANDS) if wish.stamp <= one.stamp < wish.stamp + SOON]


def _is_wish(run: Recording, command: Message) -> bool:
    wishes = [one for one in run.messages(WANTED) if one.stamp <= command.stamp]
    return bool(wishes) and abs(wishes[-1].message.data - command.message.data) < 1e-6


def _is_held(run: Recording, state: State) -> bool:
    """Whether the lift that is stuck is told in time to stay where it is."""
    return any(
        state.stamp <= command.stamp < state.stamp + REACTION
        and abs(command.message.data - state.position) < HERE
        for command in run.messages(COMMANDS)
    )


def _is_answer(run: Recording, command: Message) -> bool:
    """Whether the command holds the lift where it was stuck."""
    return any(
        state.stamp <= command.stamp < state.stamp + REACTION + SOON
        and abs(state.position - command.message.data) < HERE
        for state in _jams(run)
    )


def _states(run: Recording) -> list[State]:
    found = []
    for heard in run.messages("/joint_states"):
        if heard.from_course:
            message = heard.message
            index = list(message.name).index(JOINT)
            pulling = abs(message.effort[index]) >= EFFORT and abs(message.velocity[index]) < 1e-6
            found.append(State(heard.stamp, message.position[index], pulling, message.effort[index]))
    return found


def _jams(run: Recording) -> list[State]:
    """When and where the lift got stuck: it pulls for longer than when it begins to move."""
    found, states = [], _states(run)
    for pulling, group in itertools.groupby(states, key=lambda state: state.pulling):
        rows = list(group)
        if pulling and rows[-1].stamp - rows[0].stamp > PEAK and rows[0].stamp < run.ended.stamp - REACTION:
            found.append(rows[0])
    return found


def _values(sent: list[Message]) -> str:
    return ", ".join(f"{one.message.data:.3g}" for one in sent[:5]) or "nothing"


def _why_not_passed(run: Recording, wish: Message, wishes: list[tuple[Message, bool]]) -> str:
    """The usual reasons for a wish that isn't passed on."""
    sent = _sent_after(run, wish)
    if sent and abs(sent[0].message.data) > 3.2:
        return "Positions and limits are radians, all of them: pass the number on as it is."
    if any(not good and heard.stamp < wish.stamp for heard, good in wishes):
        bad = [heard for heard, good in wishes if not good and heard.stamp < wish.stamp]
        if not any(one.stamp > bad[0].stamp for one in run.messages(COMMANDS)):
            return "A refusal is not the end: return from the callback, and take the next wish as ever."
    lower, upper = limits_of(run)[JOINT]
    return f"It lies between the limits, {lower:g} and {upper:g} rad. Read both from the description."


def _why_beyond(run: Recording, lower: float, upper: float) -> str:
    """The usual reasons for a command beyond the limits."""
    outside = [one.message.data for one in run.messages(COMMANDS) if not lower <= one.message.data <= upper]
    if outside and all(math.isnan(value) for value in outside):
        return (
            "nan is neither below the lower limit nor above the upper one: each comparison with it is False. "
            "Ask the other way round: if not lower <= value <= upper, refuse."
        )
    return "Compare with both limits of the description before you publish, the lower one with its sign."


def _why_not_freed(run: Recording, state: State) -> str:
    later = [one for one in run.messages(COMMANDS) if one.stamp >= state.stamp and not _is_wish(run, one)]
    if state.effort < 0 and any(one.effort > 0 and _is_held(run, one) for one in _jams(run)):
        return "Here it pulls the other way, and its effort is below 0: compare abs(effort) with the limit."
    if later and abs(later[0].message.data - state.position) < HERE:
        return "That is late: half a second of pulling without a movement is enough to know."
    if later:
        return (
            f"It isn't {later[0].message.data:.2g} where it is stuck. Send the position that the message has "
            "for lift_joint: find its place in msg.name, and take position, velocity and effort from there."
        )
    return (
        "Stuck is when abs(effort) is as high as the description's limit, and abs(velocity) is 0, for half "
        "a second. Read them by the joint's name, remember since when, and compare with now."
    )
