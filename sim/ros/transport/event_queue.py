"""What happens at a certain time whatever the programs do: messages arrive, deadlines pass."""

from __future__ import annotations

import heapq
from collections.abc import Callable
from itertools import count

from sim.nanoseconds import Nanoseconds

Event = tuple[Nanoseconds, int, Callable[[], None]]


class EventQueue:
    """The appointments of one run; those of one moment are kept in the order in which they were made."""

    def __init__(self) -> None:
        self._arrivals: list[Event] = []
        self._limits: list[Event] = []
        self._numbers = count()

    def schedule_arrival(self, moment: Nanoseconds, do: Callable[[], None]) -> None:
        """Do this as time moves to `moment`, before any program goes on there."""
        heapq.heappush(self._arrivals, (moment, next(self._numbers), do))

    def schedule_deadline(self, moment: Nanoseconds, do: Callable[[], None]) -> None:
        """Do this at `moment` when all programs have done what they do there: who is just in time is."""
        heapq.heappush(self._limits, (moment, next(self._numbers), do))

    def next(self, end: Nanoseconds) -> Nanoseconds:
        """When something is to be done; `end` at the latest."""
        for events in (self._arrivals, self._limits):
            if events and events[0][0] < end:
                end = events[0][0]
        return end

    def run_arrivals(self, now: Nanoseconds) -> None:
        """Do what is to be done as a moment begins."""
        _do(self._arrivals, now)

    def run_deadlines(self, now: Nanoseconds) -> bool:
        """Do what is to be done as it ends; whether there was anything."""
        return _do(self._limits, now)


def _do(events: list[Event], now: Nanoseconds) -> bool:
    due = bool(events) and events[0][0] <= now
    while events and events[0][0] <= now:
        heapq.heappop(events)[2]()
    return due
