"""An exercise's runs happen in different orders: a check passes if it passes in each that is graded.

The first run has the usual order of what happens at the same time. Each other one has an order derived from
its seed, so that it is private when a class is marked.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import replace

from grader.checks.verdicts import Verdict
from sim.evidence import Recording
from sim.order import Order

USUAL = ""
LETTERS = "23456789abcdefghjkmnpqrstuvwxyz"  # without those that look alike
KEY_LENGTH = 4


def order_of_run(index: int, seed: int) -> str:
    """The order in which an exercise's run of this index and seed happens: its text; "" for the usual one."""
    if index == 0:
        return USUAL
    drawn = int.from_bytes(hashlib.blake2b(f"order of {seed}".encode(), digest_size=8).digest())
    return "".join(LETTERS[drawn // len(LETTERS) ** place % len(LETTERS)] for place in range(KEY_LENGTH))


def without_late_start(order: str) -> str:
    """The same order, in which all programs start at once."""
    chosen = Order.parse(order or 0)
    return USUAL if chosen is None else str(replace(chosen, late=0.0))


def is_full(verdicts: Sequence[Verdict]) -> bool:
    """Whether nothing was missed."""
    return all(verdict.status == "passed" for verdict in verdicts)


def worst_order(
    other: tuple[Recording, list[Verdict]], usual: tuple[Recording, list[Verdict]]
) -> tuple[Recording, list[Verdict]]:
    """Return the verdicts on one run in two orders, and the recording to show.

    What is missed in the usual order is explained there. Only what is missed in the other order alone is due
    to the order, and says so.
    """
    passed = {verdict.name for verdict in usual[1] if verdict.status == "passed"}
    missed = {v.name: v for v in other[1] if v.status != "passed" and v.name in passed}
    first = [verdict for verdict in other[1] if not verdict.points and verdict.name not in _names(usual[1])]
    if not missed:
        return usual
    verdicts = [missed.get(verdict.name, verdict) for verdict in usual[1]]
    verdicts = [*(first if is_full(usual[1]) else []), *verdicts]
    noted = [_with_note(v, other[0]) if missed.get(v.name) is v or v in first else v for v in verdicts]
    return other[0], noted


def _names(verdicts: Sequence[Verdict]) -> set[str]:
    return {verdict.name for verdict in verdicts}


def _with_note(verdict: Verdict, recording: Recording) -> Verdict:
    """The same verdict, which says that it is due to an order, and where the orders part."""
    if verdict.status != "failed":
        return verdict
    begin = recording.departures[0].stamp if recording.departures else 0.0
    note = f"in another order of what happened at {begin:.3g} s: {verdict.saw}"
    return replace(verdict, saw=note)
