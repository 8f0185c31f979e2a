"""Move a cart with a weak motor to the marks that come, and keep its pole up."""

import itertools

from grader.checks import hinting, otherwise, publishes, subscribes
from grader.checks.control import EFFORT, keeps_to_limits, overshoots, places, settles, stands, still_stands
from grader.checks.no_data import no_data
from grader.companions.control_streams import Marks
from grader.exercise import Exercise
from grader.responses import from_course
from grader.worlds.carts import WEAK, weak_cart
from sim.evidence import Recording, Seconds

NEAR, SOON, MOST = 0.05, 4.0, 0.12  # m, s, m
FLOAT = "std_msgs/msg/Float64"
Leg = tuple[Seconds, Seconds, float]  # from when, until when, to where

marks = Exercise(
    "marks", "To the mark", world=weak_cart, seconds=17, companions=[Marks], seeds=(1, 2), waits=False
)


@marks.check(2)
def subscribes_and_pushes(run: Recording) -> None:
    """The node subscribes to /mark, and publishes efforts on /cart_effort."""
    with hinting("The position where the cart has to be is published on /mark."):
        subscribes(run, "/mark", FLOAT)
    publishes(run, EFFORT, FLOAT, at_least=5)


@marks.check(5, after=subscribes_and_pushes)
def keeps_it_up(run: Recording) -> None:
    """The pole stays up for 17 s."""
    stands(run)


@marks.check(3, after=(subscribes_and_pushes, keeps_it_up))
def spares_the_motor(run: Recording) -> None:
    """The effort never exceeds 3 N, in either direction."""
    keeps_to_limits(run, WEAK)


@marks.check(5, after=keeps_it_up, hints={
    "First the cart has to reach the middle, where the mark is 0. Does your effort depend on "
    "x?": lambda run, mark: mark == 0.0,
    "It stays in the middle: subtract the mark from x.":
        lambda run, mark: all(abs(x) < NEAR for _, x in _reached(run)),
    "It goes to the other side: use x minus the mark.":
        lambda run, mark: all(abs(x + mark) < 2 * NEAR for mark, x in _reached(run)),
    "A larger gain on the position gets it there sooner; increase the gain on the speed along with it.":
        otherwise,
})
def comes_to_the_marks(run: Recording) -> None:
    """Four seconds after each mark arrives, the cart is within 5 cm of it, and stays there."""
    still_stands(run)
    for begin, end, mark in _legs(run):
        settles(run.during(begin, end), mark, seconds=SOON, tolerance=NEAR)


@marks.check(3, after=comes_to_the_marks)
def goes_not_far_beyond(run: Recording) -> None:
    """The cart overshoots a mark by at most 12 cm."""
    for begin, end, mark in _legs(run)[1:]:
        with hinting("A larger gain on the cart's speed brakes it earlier."):
            overshoots(run.during(begin, end), mark, most=MOST)


def _legs(run: Recording) -> list[Leg]:
    """Each mark of the course with the time in which it holds."""
    groups = itertools.groupby(from_course(run, "/mark"), key=lambda row: row.message.data)
    changes = [next(rows) for _, rows in groups]
    if len(changes) < 3:
        raise no_data(run, "three marks", f"{len(changes)}", run.graph.publishers("/mark"))
    ends = [row.stamp for row in changes[1:]] + [run.ended.stamp]
    return [(row.stamp, end, row.message.data) for row, end in zip(changes, ends, strict=True)]


def _reached(run: Recording) -> list[tuple[float, float]]:
    """Each mark but the first, and where the cart was just before the next one."""
    curve = places(run)
    return [(mark, next(x for stamp, x in reversed(curve) if stamp < end)) for _, end, mark in _legs(run)[1:]]
