"""What a fiber waits for while it spins, and how it is woken."""

from __future__ import annotations

from typing import Any

from sim.nanoseconds import Nanoseconds

NEVER: Nanoseconds = 2**63  # later than any moment of a run


class Waiter:
    """An executor for which fibers wait while they spin. Only one that was woken is looked at.

    Whatever makes work ready for it calls `wake()`. Two things don't: time, so the waiter says when its next
    timer is due; and code that changes what only polling can find, so a waiter with such work is polled.
    """

    def __init__(self) -> None:
        self.wakes = 0  # a fiber that saw fewer when it began to wait is runnable
        self.outdated = True  # entities were created or destroyed since it last looked

    def wake(self) -> None:
        """Let the fibers that wait for it look for work."""
        self.wakes += 1

    def next_due(self) -> Nanoseconds:
        """Return when its next timer is due; NEVER for none."""
        return NEVER

    def end_coroutines(self) -> None:
        """Close what is still suspended in an `await`."""

    def close(self) -> None:
        """The run is over: free the executor."""


class Waiters:
    """All waiters of a run: those that an event wakes all at once, and those that are polled."""

    def __init__(self) -> None:
        self.all: list[Any] = []  # Waiter, in the order of their creation
        self.polled: list[Waiter] = []

    def add(self, waiter: Waiter) -> None:
        """A program has created one."""
        self.all.append(waiter)

    def clear(self) -> None:
        """The run is over."""
        self.all.clear()
        self.polled.clear()

    def poll(self, waiter: Waiter) -> None:
        """From now on wake this one whenever code ran or time moved: some of its work wakes nothing."""
        if waiter not in self.polled:
            self.polled.append(waiter)

    def wake_polled(self) -> None:
        """Code ran, or time moved."""
        for waiter in self.polled:
            waiter.wakes += 1

    def wake_all(self) -> None:
        """Something happened that may concern any of them."""
        for waiter in self.all:
            waiter.wakes += 1

    def endpoints_changed(self) -> None:
        """Entities were created or destroyed, so each has to list its own anew."""
        for waiter in self.all:
            waiter.wakes += 1
            waiter.outdated = True
