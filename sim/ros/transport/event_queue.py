"""What happens at a certain time whatever the programs do: messages arrive, deadlines pass."""

from __future__ import annotations

import heapq
from collections.abc import Callable
from itertools import count

from sim.nanoseconds import Nanoseconds

Event = tuple[Nanoseconds, int, Callable[[], None]]


class EventQueue:
    """The scheduled events of one run; those of one moment happen in the order of their scheduling."""

    def __init__(self) -> None:
        self._arrivals: list[Event] = []
        self._deadlines: list[Event] = []
        self._numbers = count()

    def schedule_arrival(self, moment: Nanoseconds, do: Callable[[], None]) -> None:
        """Do this as time moves to `moment`, before any program runs there."""
        heapq.heappush(self._arrivals, (moment, next(self._numbers), do))

    def schedule_deadline(self, moment: Nanoseconds, do: Callable[[], None]) -> None:
        """Do this at `moment` once no program can go on there: what happens at the deadline is in time."""
        heapq.heappush(self._deadlines, (moment, next(self._numbers), do))

    def next_due(self, end: Nanoseconds) -> Nanoseconds:
        """Return when the next event is due; `end` at the latest."""
        for events in (self._arrivals, self._deadlines):
            if events and events[0][0] < end:
                end = events[0][0]
        return end

    def run_arrivals(self, now: Nanoseconds) -> None:
        """Do what is due as a moment begins."""
        _run(self._arrivals, now)

    def run_deadlines(self, now: Nanoseconds) -> bool:
        """Do what is due as a moment ends; whether there was anything."""
        return _run(self._deadlines, now)


def _run(events: list[Event], now: Nanoseconds) -> bool:
    due = bool(events) and events[0][0] <= now
    while events and events[0][0] <= now:
        heapq.heappop(events)[2]()
    return due
