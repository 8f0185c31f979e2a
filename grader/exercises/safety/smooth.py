"""A driver's commands, as fast and as suddenly as the robot may."""

import itertools
import math
from collections.abc import Iterator
from typing import NamedTuple

from grader.checks import Missed, publishes
from grader.checks.twists import OUT, TWIST, speeds
from grader.companions.drivers import RAW, RoughDriver
from grader.exercise import Exercise
from grader.geometry.near import is_near
from grader.responses import from_course
from grader.variants import Variants
from sim.evidence import Message, Recording, Seconds

NEAR, SOON = 1e-6, 0.1  # s, in which an answer comes
LONG = 26  # commands, 20 in a second: time enough for whatever is asked for


class Axis(NamedTuple):
    """A part of a command with its limits: the largest value, and the step away from 0."""

    name: str
    number: int
    most: float
    step: float
    unit: str


smooth = Exercise("smooth", "No jerks", world="yard", seconds=10, companions=[RoughDriver], seeds=(1, 2),
                  variants=Variants(
    {"speed": (0.3, 0.4), "speed_step": (0.025, 0.04)},
    {"turn": (1.0, 0.8), "turn_step": (0.1, 0.05)},
    texts=("{speed} m/s", "{speed_step} m/s", "self.speed, {speed}, {speed_step})", "{turn} rad/s",
           "{turn:g} rad/s", "{turn_step} rad/s", "self.turn, {turn}, {turn_step})"),
))


class Response(NamedTuple):
    """A requested value and the response, with the response before it; for one part of the command."""

    axis: Axis
    stamp: Seconds
    requested: float
    before: float
    sent: float

    @property
    def right(self) -> float:
        """Return what the limits leave of the request, in the end."""
        within = max(-self.axis.most, min(self.axis.most, self.requested))
        return within if math.isfinite(self.requested) else 0.0


@smooth.check(2)
def responds_to_each(run: Recording) -> None:
    """For each command on /cmd_vel_raw, one is published on /cmd_vel."""
    requests, sent = from_course(run, RAW, at_least=20), publishes(run, OUT, TWIST, at_least=5)
    if not len(requests) - 2 <= len(sent) <= len(requests):
        hint = "Publish once in the callback of /cmd_vel_raw, each time it is called."
        raise Missed(f"{len(requests)} messages on {OUT}", f"{len(sent)}", hint)
    for request, row in _answered(requests, sent):
        if not 0.0 <= row.stamp - request.stamp < SOON:
            hint = "Publish in the callback of /cmd_vel_raw: a driver can't wait for the answer."
            expected = f"the answer to the command of {request.stamp:.3g} s within {SOON:g} s"
            raise Missed(expected, f"it comes at {row.stamp:.3g} s", hint)


@smooth.check(5, after=responds_to_each)
def gets_there(run: Recording) -> None:
    """The robot gets the requested speed, as far as the limits allow, within 1.3 s."""
    for pair, steps in _steady(run):
        beyond = pair.sent * pair.right > 0 and abs(pair.right) < abs(pair.sent) < math.inf
        if pair.right and steps >= LONG and not (beyond and pair.requested != pair.right):
            _same(pair, pair.right, "Keep adding the step, up to the request or the limit.")


@smooth.check(2, after=gets_there)
def keeps_the_limits(run: Recording) -> None:
    """The speeds never exceed 0.3 m/s and 1 rad/s, in either direction."""
    for pair in _pairs(run):
        if not is_near(pair.sent, 0.0, pair.axis.most + NEAR):
            saw = f"{pair.sent:.3g} {pair.axis.unit} at {pair.stamp:.3g} s"
            expected = f"{pair.axis.name} up to {pair.axis.most:g} {pair.axis.unit}"
            hint = f"Clip the request first: max(-{pair.axis.most:g}, min({pair.axis.most:g}, requested))."
            raise Missed(expected, saw, hint, unsafe=True)


@smooth.check(5, after=gets_there)
def speeds_up_gently(run: Recording) -> None:
    """Away from 0, speeds grow by at most 0.025 m/s and 0.1 rad/s per command, in either direction."""
    for pair in _pairs(run):
        growth = abs(pair.sent) - (abs(pair.before) if pair.sent * pair.before > 0 else 0.0)
        if not growth <= pair.axis.step + NEAR:
            saw = f"{pair.before:.3g} and then {pair.sent:.3g} {pair.axis.unit} at {pair.stamp:.3g} s"
            expected = f"{pair.axis.name} that grows by {pair.axis.step:g} {pair.axis.unit} at most"
            raise Missed(expected, saw, _why_jerky(pair))


@smooth.check(2, after=gets_there)
def stops_at_once(run: Recording) -> None:
    """Slowing down is not limited: a request of 0 is obeyed at once."""
    for pair in _pairs(run):
        if pair.requested == 0.0:
            hint = ("A limit on braking makes the stopping distance longer: limit the step only when the "
                    "speed grows.")
            _same(pair, 0.0, hint, unsafe=True)


@smooth.check(2, after=gets_there)
def takes_no_nonsense(run: Recording) -> None:
    """A request that isn't a finite number counts as 0, and the next valid one is obeyed again."""
    for pair in _pairs(run):
        if not math.isfinite(pair.requested):
            hint = ("min and max let NaN through, or turn it into the limit. Check math.isfinite(requested) "
                    "first.")
            _same(pair, 0.0, hint, unsafe=True)


def _same(pair: Response, right: float, hint: str, *, unsafe: bool = False) -> None:
    if not is_near(pair.sent, right, 1e-3):
        expected = (f"{pair.axis.name} {right:.3g} {pair.axis.unit} at {pair.stamp:.3g} s, for "
                    f"{pair.requested:.3g}")
        raise Missed(expected, f"{pair.sent:.3g}", hint, picture="topics", unsafe=unsafe)


def _answered(requests: list[Message], sent: list[Message]) -> list[tuple[Message, Message]]:
    """Each request with its response: the first request may have been sent before the node was there."""
    late = len(requests) - len(sent) if sent and sent[0].stamp > requests[0].stamp + 0.04 else 0
    return list(zip(requests[max(0, late) :], sent, strict=False))


def _pairs(run: Recording) -> Iterator[Response]:
    requests, sent = from_course(run, RAW, at_least=20), publishes(run, OUT, TWIST)
    limits = smooth.drawn
    axes = (Axis("linear.x", 0, limits.speed, limits.speed_step, "m/s"),
            Axis("angular.z", 1, limits.turn, limits.turn_step, "rad/s"))
    for axis in axes:
        before = 0.0
        for request, row in _answered(requests, sent):
            value = speeds(row)[axis.number]
            yield Response(axis, row.stamp, speeds(request)[axis.number], before, value)
            before = value


def _steady(run: Recording) -> Iterator[tuple[Response, int]]:
    """Each response with how often the same request had come before, in a row."""
    for _, group in itertools.groupby(_pairs(run), key=lambda pair: (pair.axis, pair.requested)):
        for steps, pair in enumerate(group):
            yield pair, steps


def _why_jerky(pair: Response) -> str:
    if pair.sent * pair.before < 0:
        return "From forwards to backwards the speed passes through 0: start the step from 0."
    if pair.sent < 0:
        return "The same limits apply backwards: the sign of the request decides the direction of the step."
    return "Store the speed you sent last, and go at most one step beyond it."
