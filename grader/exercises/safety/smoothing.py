"""An exercise on limits: what a driver asks for, as fast and as suddenly as the robot may."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from typing import NamedTuple

from grader.checks import Missed, hinting, publishes
from grader.exercise import Exercise
from grader.exercises.safety.moving import OUT, TWIST, ours, speeds
from grader.exercises.safety.partners import RAW, Rough
from sim.evidence import Message, Recording, Seconds

NEAR, SOON = 1e-6, 0.1  # s, in which an answer comes
LONG = 26  # commands, 20 in a second: time enough for whatever is asked for


class Axis(NamedTuple):
    """A part of a command with its limits: the largest value, and the step away from 0."""

    name: str
    index: int
    most: float
    step: float
    unit: str


AXES = (Axis("linear.x", 0, 0.3, 0.025, "m/s"), Axis("angular.z", 1, 1.0, 0.1, "rad/s"))

smooth = Exercise("smooth", "No jerks", world="yard", seconds=10, companions=[Rough], seeds=(1, 2))


class Pair(NamedTuple):
    """A wish of ours and the answer, with the answer before it; for one part of the command."""

    axis: Axis
    stamp: Seconds
    wish: float
    before: float
    sent: float

    @property
    def right(self) -> float:
        """What the limits leave of the wish, in the end."""
        return max(-self.axis.most, min(self.axis.most, self.wish)) if math.isfinite(self.wish) else 0.0


@smooth.check(2)
def answers_each(run: Recording) -> None:
    """With each command on /cmd_vel_raw, one comes on /cmd_vel."""
    with hinting(guess="A subscription to /cmd_vel_raw, and a publisher that is used in its callback."):
        wishes, sent = ours(run, RAW, at_least=20), publishes(run, OUT, TWIST, at_least=5)
    if not len(wishes) - 2 <= len(sent) <= len(wishes):
        hint = "Publish once in the callback of /cmd_vel_raw, each time it is called."
        raise Missed(f"{len(wishes)} messages on {OUT}", f"{len(sent)}", hint)
    for wish, one in _answered(wishes, sent):
        if not 0.0 <= one.stamp - wish.stamp < SOON:
            hint = "Publish in the callback of /cmd_vel_raw: who drives can't wait for the answer."
            expected = f"the answer to the command of {wish.stamp:.3g} s within {SOON:g} s"
            raise Missed(expected, f"it comes at {one.stamp:.3g} s", hint)


@smooth.check(5, after=answers_each)
def gets_there(run: Recording) -> None:
    """The robot gets what is asked for, as far as the limits allow, within 1.3 s."""
    for pair, steps in _steady(run):
        beyond = abs(pair.sent) > abs(pair.right) and pair.sent * pair.right > 0 and pair.wish != pair.right
        if pair.right and steps >= LONG and not beyond:
            _same(pair, pair.right, "Add the step again and again, until the wish is reached, or the limit.")


@smooth.check(2, after=gets_there)
def keeps_the_limits(run: Recording) -> None:
    """Never more than 0.3 m/s and 1 rad/s, either way."""
    for pair in _pairs(run):
        if not abs(pair.sent) <= pair.axis.most + NEAR:
            saw = f"{pair.sent:.3g} {pair.axis.unit} at {pair.stamp:.3g} s"
            expected = f"{pair.axis.name} up to {pair.axis.most:g} {pair.axis.unit}"
            hint = f"Cut the wish first: max(-{pair.axis.most:g}, min({pair.axis.most:g}, wish))."
            raise Missed(expected, saw, hint, unsafe=True)


@smooth.check(5, after=gets_there)
def speeds_up_gently(run: Recording) -> None:
    """Away from 0, speeds grow by at most 0.025 m/s and 0.1 rad/s with each command, either way."""
    for pair in _pairs(run):
        growth = abs(pair.sent) - (abs(pair.before) if pair.sent * pair.before > 0 else 0.0)
        if not growth <= pair.axis.step + NEAR:
            saw = f"{pair.before:.3g} and then {pair.sent:.3g} {pair.axis.unit} at {pair.stamp:.3g} s"
            expected = f"{pair.axis.name} that grows by {pair.axis.step:g} {pair.axis.unit} at most"
            raise Missed(expected, saw, _why_jerky(pair))


@smooth.check(2, after=gets_there)
def stops_at_once(run: Recording) -> None:
    """To slow down takes no time: a wish of 0 is obeyed at once."""
    for pair in _pairs(run):
        if pair.wish == 0.0:
            hint = "A limit on braking makes the way to stop longer: step only where the speed grows."
            _same(pair, 0.0, hint, unsafe=True)


@smooth.check(2, after=gets_there)
def takes_no_nonsense(run: Recording) -> None:
    """A wish that is no finite number counts as 0, and the next good one is obeyed again."""
    for pair in _pairs(run):
        if not math.isfinite(pair.wish):
            hint = "min and max let NaN through, or make the limit of it. Ask math.isfinite(wish) first."
            _same(pair, 0.0, hint, unsafe=True)


def _same(pair: Pair, right: float, hint: str, *, unsafe: bool = False) -> None:
    if not abs(pair.sent - right) < 1e-3:
        expected = f"{pair.axis.name} {right:.3g} {pair.axis.unit} at {pair.stamp:.3g} s, for {pair.wish:.3g}"
        raise Missed(expected, f"{pair.sent:.3g}", hint, picture="topics", unsafe=unsafe)


def _answered(wishes: list[Message], sent: list[Message]) -> list[tuple[Message, Message]]:
    """Each wish with its answer: the first wish may have been sent before the node was there."""
    late = len(wishes) - len(sent) if sent and sent[0].stamp > wishes[0].stamp + 0.04 else 0
    return list(zip(wishes[max(0, late) :], sent, strict=False))


def _pairs(run: Recording) -> Iterator[Pair]:
    wishes, sent = ours(run, RAW, at_least=20), publishes(run, OUT, TWIST)
    for axis in AXES:
        before = 0.0
        for wish, one in _answered(wishes, sent):
            value = speeds(one)[axis.index]
            yield Pair(axis, one.stamp, speeds(wish)[axis.index], before, value)
            before = value


def _steady(run: Recording) -> Iterator[tuple[Pair, int]]:
    """Each pair with how often its wish had come before, one after another."""
    for _, group in itertools.groupby(_pairs(run), key=lambda pair: (pair.axis, pair.wish)):
        for steps, pair in enumerate(group):
            yield pair, steps


def _why_jerky(pair: Pair) -> str:
    if pair.sent * pair.before < 0:
        return "From forwards to backwards it goes through 0: take 0 as the speed to step away from."
    if pair.sent < 0:
        return "Backwards is as fast as forwards: the sign of the wish decides which way the step goes."
    return "Remember what you sent last, and go at most one step beyond it."
