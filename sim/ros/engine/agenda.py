"""What happens at a certain time whatever the programs do: messages arrive, deadlines pass."""

from __future__ import annotations

import heapq
from collections.abc import Callable
from itertools import count

from sim.nanoseconds import Nanoseconds

Plan = tuple[Nanoseconds, int, Callable[[], None]]


class Agenda:
    """The appointments of one run; those of one moment are kept in the order in which they were made."""

    def __init__(self) -> None:
        self._arrivals: list[Plan] = []
        self._limits: list[Plan] = []
        self._numbers = count()

    def arrive(self, moment: Nanoseconds, do: Callable[[], None]) -> None:
        """Do this as time moves to `moment`, before any program goes on there."""
        heapq.heappush(self._arrivals, (moment, next(self._numbers), do))

    def expire(self, moment: Nanoseconds, do: Callable[[], None]) -> None:
        """Do this at `moment` when all programs have done what they do there: who is just in time is."""
        heapq.heappush(self._limits, (moment, next(self._numbers), do))

    def next(self, end: Nanoseconds) -> Nanoseconds:
        """When something is to be done; `end` at the latest."""
        for plans in (self._arrivals, self._limits):
            if plans and plans[0][0] < end:
                end = plans[0][0]
        return end

    def let_arrive(self, now: Nanoseconds) -> None:
        """Do what is to be done as a moment begins."""
        _do(self._arrivals, now)

    def let_expire(self, now: Nanoseconds) -> bool:
        """Do what is to be done as it ends; whether there was anything."""
        return _do(self._limits, now)


def _do(plans: list[Plan], now: Nanoseconds) -> bool:
    due = bool(plans) and plans[0][0] <= now
    while plans and plans[0][0] <= now:
        heapq.heappop(plans)[2]()
    return due
