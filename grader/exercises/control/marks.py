"""An exercise on a cart that has to be where it is told, with a motor that is weak."""

from __future__ import annotations

import itertools

from grader.checks import (
    hinting,
    keeps_to_limits,
    overshoots,
    places,
    publishes,
    settles,
    stands,
    still_stands,
    subscribes,
)
from grader.checks.control import EFFORT
from grader.checks.no_data import no_data
from grader.exercise import Exercise
from grader.exercises.control.partners import Marks
from grader.exercises.control.places import WEAK, weak_cart
from sim.evidence import Recording, Seconds

NEAR, SOON, MOST = 0.05, 4.0, 0.12  # m, s, m
FLOAT = "std_msgs/msg/Float64"

marks = Exercise("marks", "To the mark", world=weak_cart, seconds=17, companions=[Marks], seeds=(1, 2))
Leg = tuple[Seconds, Seconds, float]  # from when, until when, to where


@marks.check(2)
def hears_and_pushes(run: Recording) -> None:
    """The node hears /mark, and publishes efforts on /cart_effort."""
    with hinting("Where the cart has to be comes on /mark."):
        subscribes(run, "/mark", FLOAT)
    publishes(run, EFFORT, FLOAT, at_least=5)


@marks.check(5, after=hears_and_pushes)
def keeps_it_up(run: Recording) -> None:
    """The pole stands for 17 s."""
    stands(run)


@marks.check(3, after=(hears_and_pushes, keeps_it_up))
def spares_the_motor(run: Recording) -> None:
    """No effort is beyond 3 N, either way."""
    keeps_to_limits(run, WEAK)


@marks.check(5, after=keeps_it_up)
def comes_to_the_marks(run: Recording) -> None:
    """Four seconds after each mark has come, the cart is within 5 cm of it, and stays there."""
    still_stands(run)
    for begin, end, mark in _legs(run):
        with hinting(_why_not_there(run, mark)):
            settles(run.during(begin, end), mark, seconds=SOON, tolerance=NEAR)


@marks.check(3, after=comes_to_the_marks)
def goes_not_far_beyond(run: Recording) -> None:
    """It goes at most 12 cm beyond a mark."""
    for begin, end, mark in _legs(run)[1:]:
        with hinting("More weight on the speed of the cart brakes it earlier."):
            overshoots(run.during(begin, end), mark, most=MOST)


def _legs(run: Recording) -> list[Leg]:
    """Each of our marks with the time in which it holds."""
    said = [(heard.stamp, heard.message.data) for heard in run.messages("/mark") if heard.from_course]
    changes = [said[0]] if said else []
    changes += [after for before, after in itertools.pairwise(said) if after[1] != before[1]]
    if len(changes) < 3:
        raise no_data(run, "three marks", f"{len(changes)}", run.graph.publishers("/mark"))
    ends = [begin for begin, _ in changes[1:]] + [run.ended.stamp]
    return [(begin, end, mark) for (begin, mark), end in zip(changes, ends, strict=True)]


def _why_not_there(run: Recording, mark: float) -> str:
    """The usual reasons for being elsewhere."""
    if mark == 0.0:
        return "First it has to come to the middle, where the mark is 0. Does x count?"
    curve = places(run)
    legs = _legs(run)[1:]
    reached = [next(x for stamp, x in reversed(curve) if stamp < end) for _, end, _ in legs]
    if all(abs(x) < NEAR for x in reached):
        return "It stays in the middle: take the mark away from x."
    if all(abs(x + mark) < 2 * NEAR for x, (_, _, mark) in zip(reached, legs, strict=True)):
        return "It goes to the other side: it is x minus the mark."
    return "A larger gain on the place brings it there sooner; with it, the one on the speed has to grow."
