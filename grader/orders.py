"""An exercise's runs happen in different orders: a check passes if it passes in each that is graded.

Each run has an order of what happens at the same time that is derived from its seed, so that it is private
when a class is marked. Only in a student's own notebook the first run has the usual order. Nothing that a
program does changes the order of its other runs. Where a run misses something new, it is judged in the usual
order as well, in which a mistake is easiest to see.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from grader.checks.verdicts import WORST_FIRST, Verdict, rank
from sim.evidence import Recording
from sim.order import Order
from sim.ros.exploring import consequences, list_departures, shrink

USUAL = ""
PASSED = True, 1.0, WORST_FIRST.index("passed")
POINTS, ALL_OF_IT = 2, 3  # parts of a verdict's rank: those that decide on points, and its words as well
LETTERS = "23456789abcdefghjkmnpqrstuvwxyz"  # without those that look alike
KEY_LENGTH = 4
MOST_RUNS, MOST_SECONDS = 24, 120.0  # simulated, to find the fewest differences that explain a miss

Judged = tuple[Recording, list[Verdict]]


def order_of_run(index: int, seed: int, *, public: bool) -> str:
    """The order in which an exercise's run of this index and seed happens: its text; "" for the usual one.

    public: the seed is not a private one.
    """
    if public and index == 0:
        return USUAL
    drawn = int.from_bytes(hashlib.blake2b(f"order of {seed}".encode(), digest_size=8).digest())
    return "".join(LETTERS[drawn // len(LETTERS) ** place % len(LETTERS)] for place in range(KEY_LENGTH))


def without_late_start(order: str) -> str:
    """The same order, in which all programs start at once."""
    chosen = Order.parse(order)
    return USUAL if chosen is None else str(replace(chosen, late=0.0))


@dataclass(frozen=True)
class OrderDifference:
    """The reason why nodes miss points in another order alone: for the student, as text and as HTML.

    run: the index of the exercise's run. usual, other: that run in both orders. public: its world is no
    secret, so that the student may try the order.
    """

    run: int
    usual: Recording
    other: Recording
    public: bool

    def __repr__(self) -> str:
        differences = list_departures(self.other.departures)
        follows = consequences(self.usual, self.other)
        text = f"On a robot this order is possible, too: {differences}. {follows}".rstrip()
        again = f" Try it: explore(..., holds=EXERCISE), or in_order(..., order={self.other.order!r})."
        return text + (again if self.public else "")

    def _repr_html_(self) -> str:
        from sim.view.order_comparison import comparison

        return comparison(repr(self), self.usual, self.other)


def judge_in_orders(
    order: str, judge: Callable[[str], Judged], earlier: Sequence[Sequence[Verdict]], public: bool
) -> tuple[Judged, OrderDifference | None]:
    """Judge one run in an order; where it misses more than the earlier runs, in the usual one as well.

    earlier: the verdicts of the runs before. Each check gets the worse of its two verdicts. What is missed in
    the other order alone is due to the order, and says so; then the run with the fewest differences is shown.
    """
    found = judge(order)
    before = [verdict for verdicts in earlier for verdict in verdicts]
    if order == USUAL or not _worse(found[1], before, ALL_OF_IT):
        return found, None
    usual = judge(USUAL)
    due = {verdict.name: verdict for verdict in _worse(found[1], usual[1], POINTS)}
    if not due:
        return usual, None
    recording = _fewest_differences(found[0], order, judge, set(due))
    noted = {name: _with_note(verdict, recording) for name, verdict in due.items()}
    errors = [verdict for name, verdict in noted.items() if name not in {other.name for other in usual[1]}]
    verdicts = [*errors, *(noted.get(verdict.name, verdict) for verdict in usual[1])]
    return (recording, verdicts), OrderDifference(len(earlier), usual[0], recording, public)


def _worse(verdicts: Sequence[Verdict], others: Sequence[Verdict], parts: int) -> list[Verdict]:
    """The verdicts that come before all others on the same check, by so many parts of their rank."""
    worst: dict[str, tuple[Any, ...]] = {}
    for verdict in others:
        worst[verdict.name] = min(worst.get(verdict.name, PASSED), rank(verdict))
    return [each for each in verdicts if rank(each)[:parts] < worst.get(each.name, PASSED)[:parts]]


def _fewest_differences(
    recording: Recording, order: str, judge: Callable[[str], Judged], due: set[str]
) -> Recording:
    """The run with the fewest departures in which one of these checks still misses."""
    best, whole, runs = recording, Order.parse(order), 0
    assert whole is not None, "the usual order has no departures"
    most = min(MOST_RUNS, int(MOST_SECONDS / max(recording.stamp, 1.0)))

    def fails(ids: list[str]) -> bool:
        nonlocal best, runs
        runs += 1
        if runs > most:
            return False
        tried, verdicts = judge(str(whole.limited_to(frozenset(ids))))
        missed = any(verdict.name in due and verdict.status != "passed" for verdict in verdicts)
        if missed and tried.departures and len(tried.departures) <= len(best.departures):
            best = tried
        return missed

    for _ in shrink([departure.id for departure in recording.departures], fails):
        pass
    return best


def _with_note(verdict: Verdict, recording: Recording) -> Verdict:
    """The same verdict, which says that it is due to an order, and where the orders part."""
    if verdict.status != "failed" or not recording.departures:
        return verdict
    begin = recording.departures[0].stamp
    return replace(verdict, saw=f"in another order of the events at {begin:.3g} s: {verdict.saw}")
