"""Measures over a cart and its pole, and over when messages come: meters, radians, newtons, seconds."""

from __future__ import annotations

import bisect
import itertools
import math

import numpy as np

from grader.checks.check import Missed
from grader.checks.topics import publishes, within
from grader.checks.work import worked_until
from grader.geometry.near import is_near
from sim.evidence import Recording, Seconds

EFFORT = "/cart_effort"
FALLEN = 0.5  # rad: from there on no cart catches it
Curve = list[tuple[Seconds, float]]
WRONG_WAY = (
    "The cart is pushed the wrong way from the start. A positive angle means that the pole leans to the "
    "left: the cart has to get under it, to the left, which takes a negative effort."
)
TOO_WEAK = (
    "The pole fell to the side it leaned to from the start: the cart didn't get under it. Is the gain on the "
    "angle large enough, and does the one on the rate have the same sign?"
)
SWINGS = (
    "It swung more and more widely, as it does with P alone. Add D, a gain on the pole's rate, with the same "
    "sign. If you have it already, make it larger."
)
PLACE_TURNED = (
    "The position has the wrong sign, which drives the cart away: to come back from the right, it first has "
    "to push to the right, so that the pole leans to the left. Add gain * x for the position, with a plus."
)
NOT_FINITE = "An effort was {push}, which the cart refuses: check how it is calculated. Did it divide by 0?"
ENDED = (
    "After {last:.3g} s no effort came any more, and the cart kept to that one. Publish one for each joint "
    "state, from start to end."
)
LATE = 0.3  # s without an effort until the fall
NO_EFFORT = "Nothing pushed the cart: publish an effort on /cart_effort each time a joint state arrives."


def lean(run: Recording) -> Curve:
    """The pole's true angle over time, rad; 0 upright, counter-clockwise."""
    poses = run.tracks.get("pole", [])
    return [(pose.stamp, math.remainder(pose.yaw - math.pi / 2, math.tau)) for pose in poses]


def places(run: Recording) -> Curve:
    """The cart's true place over time, m to the right of the middle."""
    return [(pose.stamp, pose.x) for pose in run.tracks.get("cart", [])]


def fell_at(run: Recording) -> Seconds | None:
    """Return when the pole first leant by more than 0.5 rad; None where it stood. Needs a pole."""
    angles = lean(run)
    if not angles:
        raise ValueError("this run has no pole: give the exercise a world that has one")
    return next((stamp for stamp, angle in angles if not is_near(angle, 0.0, FALLEN)), None)


def stands(run: Recording) -> None:
    """The pole stands to the end. Raises Missed where it fell; with credit from half of the time on."""
    fell = fell_at(run)
    if fell is None:
        return
    share = fell / run.seconds
    raise Missed(
        f"a pole that stands for {run.seconds:g} s",
        f"it fell: at {fell:.3g} s it leaned by more than {FALLEN:g} rad",
        _why_it_fell(run, fell),
        credit=0.5 * share if share >= 0.5 else 0.0,
    )


def still_stands(run: Recording) -> None:
    """Raises Missed where the pole fell: what is asked of a cart that carries it can't be judged then."""
    fell = fell_at(run)
    if fell is not None:
        raise Missed("a pole that stands meanwhile", f"it fell at {fell:.3g} s", "Keep the pole up first.")


def settles(run: Recording, target: float, *, seconds: Seconds, tolerance: float) -> Seconds:
    """Return how long it takes the cart, from the recording's begin on, to be near a place for good.

    Raises Missed where it takes longer than `seconds`.
    """
    away = [stamp for stamp, x in places(run) if not is_near(x, target, tolerance)]
    took = away[-1] - run.begin if away else 0.0
    if took > seconds:
        end, x = places(run)[-1]
        raise Missed(
            f"the cart within {tolerance * 100:g} cm of {target:.2f} m, from {seconds:g} s after "
            f"{run.begin:.3g} s on",
            f"it is farther away until {away[-1]:.3g} s" if end > away[-1] else f"{x:.2f} m at {end:.3g} s",
            about=(target,),
        )
    return took


def overshoots(run: Recording, target: float, *, most: float) -> float:
    """Return how far (m) the cart goes beyond a place, seen from where it begins. Missed if too far."""
    curve = places(run)
    side = math.copysign(1.0, target - curve[0][1])
    beyond = max((side * (x - target), stamp) for stamp, x in curve)
    if beyond[0] > most:
        raise Missed(
            f"at most {most * 100:g} cm beyond {target:.2f} m",
            f"{beyond[0] * 100:.0f} cm beyond it at {beyond[1]:.3g} s",
        )
    return max(beyond[0], 0.0)


def keeps_to_limits(run: Recording, most: float) -> None:
    """All efforts are numbers from -most to most, N. Raises Missed for the first that isn't."""
    hint = f"Clip it before you publish it: max(-{most:g}, min({most:g}, effort))."
    try:
        within(run, EFFORT, "data", -most, most, unit="N")
    except Missed as missed:
        missed.hint = missed.hint or hint
        raise


def keeps_deadline(
    run: Recording, topic: str, limit: Seconds, *, hint: str = "", begin: Seconds = 0.2
) -> Seconds:
    """The longest time between two messages, from `begin` on.

    Raises Missed where it is longer than `limit`, with how often it was: each time is a missed deadline.
    """
    sent = [received.stamp for received in publishes(run, topic) if received.stamp >= begin]
    moments = [begin, *sent, max(worked_until(run), begin)]
    late = [(b - a, a) for a, b in itertools.pairwise(moments) if b - a > limit + 1e-6]
    if late:
        longest, since = max(late)
        raise Missed(
            f"a message on {topic} at least every {limit:g} s",
            f"{len(late)} {'deadline' if len(late) == 1 else 'deadlines'} missed, the worst by "
            f"{longest - limit:.3g} s, after {since:.3g} s",
            hint,
            picture="topics",
        )
    return max(b - a for a, b in itertools.pairwise(moments))


def _place_is_turned(run: Recording, fell: Seconds) -> bool:
    """Return whether efforts grow to the left as the cart moves right, by a fit to the joint states."""
    states = [row for row in run.messages("/joint_states") if row.stamp < fell]
    stamps = [row.stamp for row in states]
    sent = [(bisect.bisect_right(stamps, row.stamp), row) for row in run.messages(EFFORT) if row.stamp < fell]
    pairs = [(states[index - 1].message, row.message.data) for index, row in sent if index]
    limit = max((abs(push) for _, push in pairs), default=0.0)
    free = [(state, push) for state, push in pairs if abs(push) < 0.99 * limit]
    if len(free) < 20:
        return False
    known = [[*state.position[:2], *state.velocity[:2], 1.0] for state, _ in free]
    gains, *_ = np.linalg.lstsq(np.array(known), np.array([push for _, push in free]), rcond=None)
    return bool(gains[0] < -0.5)


def _why_it_fell(run: Recording, fell: Seconds) -> str:
    """The causes that can be seen in the efforts and the cart."""
    sent = [(effort.stamp, effort.message.data) for effort in run.messages(EFFORT) if effort.stamp < fell]
    if not sent:
        return NO_EFFORT
    refused = next((push for _, push in sent if not math.isfinite(push)), None)
    if refused is not None:
        return NOT_FINITE.format(push=refused)
    if fell - sent[-1][0] > LATE:
        return ENDED.format(last=sent[-1][0])
    first = next((push for _, push in sent if push), 0.0)
    if first * lean(run)[0][1] > 0:
        return WRONG_WAY
    gaps = [b - a for a, b in itertools.pairwise([stamp for stamp, _ in sent])]
    slow = max(gaps, default=0.0)
    if slow > 0.045:
        return (
            f"The efforts were too rare: up to {slow:.2g} s passed between two of them, and the pole falls "
            "in the meantime. Publish one for each joint state, and let nothing block the loop."
        )
    assert run.world is not None and run.world.machine is not None, "a cart is in a world, and is a machine"
    end = run.world.machine.track_length / 2
    if any(not is_near(x, 0.0, end - 0.01) for stamp, x in places(run) if stamp <= fell):
        rolled = "The cart rolled to the end of the track, which stopped it."
        depends = "The effort has to depend on its position, too."
        return f"{rolled} {PLACE_TURNED if _place_is_turned(run, fell) else depends}"
    swings = {angle > 0 for stamp, angle in lean(run) if stamp < fell and not is_near(angle, 0.0, 0.02)}
    return TOO_WEAK if len(swings) == 1 else SWINGS
