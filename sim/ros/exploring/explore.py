"""`explore` runs nodes in many orders, until they fail in one; then it looks for the fewest differences."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator
from contextvars import ContextVar
from typing import Any, Protocol

from sim.evidence import Recording
from sim.notebook import in_notebook, raise_if_outdated
from sim.order import LEVELS, NETWORK, SPREAD, Order
from sim.ros.engine.preemption import Observer
from sim.ros.exploring.explored import Explored
from sim.ros.exploring.race import race
from sim.ros.exploring.shrink import shrink
from sim.ros.run import run

MOST_SHRINKING = 300  # runs
FURTHER = 40  # orders that are tried after the first that fails, as long as more than one departure is left
AGAIN = 10  # runs in the order that was found
SILENT = {"quiet": True, "expect_error": True}
_only_first: ContextVar[bool] = ContextVar("only_first", default=False)

Holds = Callable[[Recording], bool]
Attempt = Callable[[str | int], tuple[Recording, bool]]


class Progress(Protocol):
    """Shows how far a search is."""

    def show(self, text: str, done: int) -> None:
        """Say what is going on; done: the number of orders tried."""

    def end(self) -> None:
        """The search is over."""


class Judge(Protocol):
    """An exercise: it runs the nodes itself."""

    def in_order(self, *nodes: Any, order: str | int) -> tuple[Recording, bool]:
        """Run the nodes in this order: the run to look at, and whether they earn full points."""


@contextlib.contextmanager
def stopping_at_the_first() -> Iterator[None]:
    """In this block, `explore` ends with the first order that fails, and doesn't explain it."""
    token = _only_first.set(True)
    try:
        yield
    finally:
        _only_first.reset(token)


def explore(
    *nodes: Any,
    holds: Holds | Judge,
    orders: int = 100,
    level: str = NETWORK,
    spread: float = SPREAD,
    **arguments: Any,
) -> Explored:
    """Run nodes in many orders that are possible on a robot, until something does not hold in one.

    holds: called with each run's recording; or an exercise, which runs the nodes itself: full points hold.
    orders: how many to try. level: "host" varies what varies between the programs of one machine, and
        between threads; "network" also what varies between machines; "any" all that nothing guarantees.
    spread: by how much a message may be late, in seconds.
    arguments: those of `run`; what the nodes print and log is not shown.

    Raises ValueError for a level or a number of orders that can't be, and what `run` raises. Ctrl-C ends the
    search, and the result is the best so far.
    """
    if level not in LEVELS:
        raise ValueError(f"level must be 'host', 'network' or 'any'; it is {level!r}.")
    if isinstance(orders, bool) or not isinstance(orders, int) or orders < 1:
        raise ValueError(f"orders must be a whole number, 1 or more; it is {orders!r}.")
    if not 0 < spread <= 1:
        raise ValueError(f"spread must be seconds, more than 0 and at most 1; it is {spread!r}.")
    raise_if_outdated(nodes)
    search = _Search(_attempt(nodes, holds, arguments), orders, level, spread)
    try:
        with search.observer.active():
            search.run()
    except KeyboardInterrupt:
        search.found.interrupted = True
        if search.found.usual.stamp == 0:
            raise
    finally:
        search.progress.end()
    return search.found


def _attempt(nodes: tuple[Any, ...], holds: Holds | Judge, arguments: dict[str, Any]) -> Attempt:
    if hasattr(holds, "in_order"):
        return lambda order: holds.in_order(*nodes, order=order)

    def attempt(order: str | int) -> tuple[Recording, bool]:
        recording = run(*nodes, **(SILENT | arguments), order=order)
        return recording, bool(holds(recording))

    return attempt


class _Search:
    """One search. The result grows in `found`."""

    def __init__(self, attempt: Attempt, orders: int, level: str, spread: float) -> None:
        self.progress = _progress(orders)
        self.observer = Observer()
        self.found = Explored(Recording(), level=level, unseen=self.observer.unseen)
        self._attempt, self._orders, self._level, self._spread = attempt, orders, level, spread

    def run(self) -> None:
        """Try the usual order, then the others; shrink the first that fails."""
        found = self.found
        found.usual, holds = self._attempt(0)
        if not holds:
            found.failed, found.recording = 0, found.usual
            return
        for number in range(1, self._orders + 1):
            fails = self._try(number)
            found.tried = number
            if fails:
                break
        else:
            return
        if _only_first.get():
            return
        for number in range(found.tried + 1, min(found.tried + FURTHER, self._orders) + 1):
            if len(found.departures) == 1:
                break
            self._try(number)
        self._explain()

    def _try(self, number: int) -> bool:
        """Try an order; whether it fails. Then store it with fewest departures, if no other has fewer."""
        self.progress.show(f"order {number} of {self._orders}", number)
        order = Order(str(number), self._level, self._spread)
        recording, holds = self._attempt(str(order))
        if holds:
            return False
        best, limited = recording, order
        runs = 0

        def fails(ids: list[str]) -> bool:
            nonlocal best, limited, runs
            runs += 1
            if runs > MOST_SHRINKING:
                return False
            self.progress.show(f"order {number} fails; {len(ids)} departures", number)
            tried = order.limited_to(frozenset(ids))
            recording, holds = self._attempt(str(tried))
            if not holds and len(recording.departures) <= len(best.departures):
                best, limited = recording, tried
            return not holds

        ids = [departure.id for departure in recording.departures]
        found = self.found
        try:
            if ids and not _only_first.get() and fails(ids):
                for _ in shrink(ids, fails):
                    pass
        finally:
            if found.failed is None or len(best.departures) < len(found.departures):
                found.failed, found.number, found.recording = str(limited), number, best
        return True

    def _explain(self) -> None:
        """Repeat the order that was found, and tell what the functions did in it."""
        found, observer = self.found, self.observer
        observer.logs = True
        self._attempt(0)
        usual = observer.log
        self._attempt(found.failed)
        failed, observer.logs = observer.log, False
        found.race = race(usual, failed, found.recording)
        found.stopped = [text for text in failed.stopped if text not in usual.stopped]
        for _ in range(AGAIN):
            self.progress.show(f"again in order {found.number}", found.number)
            found.again += not self._attempt(found.failed)[1]
            found.repeated += 1


def _progress(orders: int) -> Progress:
    """Return what shows how far the search is: a bar in a notebook, a line in a terminal."""
    if in_notebook():
        from sim.view.progress_bar import ProgressBar  # imported here because it is slow

        return ProgressBar(orders)
    return _Line(orders)


class _Line:
    """A line in a terminal that is replaced again and again; nothing elsewhere."""

    def __init__(self, orders: int) -> None:
        self._orders, self._width, self._shown = orders, 0, sys.stderr.isatty()

    def show(self, text: str, done: int) -> None:
        """Work like Progress."""
        if self._shown:
            line = f"[{'#' * (20 * done // self._orders):<20}] {text}"
            print(f"\r{line:<{self._width}}", end="", file=sys.stderr, flush=True)
            self._width = len(line)

    def end(self) -> None:
        """Work like Progress."""
        if self._width:
            print("\r" + " " * self._width + "\r", end="", file=sys.stderr, flush=True)
