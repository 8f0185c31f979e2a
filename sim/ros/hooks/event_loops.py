"""asyncio's event loops, and `select()`, wait in simulated time while other fibers run."""

from __future__ import annotations

import select as polling
import selectors
from collections.abc import Callable, Iterable
from typing import Any

from sim.nanoseconds import nanoseconds
from sim.ros.fibers.scheduler import engine
from sim.ros.hooks.table import hook


def _wait(run: Any, what: str, timeout: float | None, is_ready: Callable[[], Any]) -> None:
    """Wait until it is, for so many simulated seconds at most; None: forever."""
    if not is_ready() and (timeout is None or timeout > 0):
        until = None if timeout is None else run.now + nanoseconds(timeout)
        run.wait(what, ready=is_ready, until=until)


@hook(selectors.DefaultSelector, "select", "event loops wait in it, in wall time, and no fiber could run")
def select(original: Callable) -> Callable:
    def select(self: selectors.BaseSelector, timeout: float | None = None) -> list[Any]:
        run = engine()
        if run is None:
            return original(self, timeout)
        # Another fiber's call_soon_threadsafe() writes to a socket that the selector watches.
        _wait(run, "an event in asyncio's loop", timeout, lambda: original(self, 0))
        return original(self, 0)

    return select


@hook(polling, "select", "it waits in wall time, and no fiber could run")
def select_files(original: Callable) -> Callable:
    def select(
        rlist: Iterable[Any], wlist: Iterable[Any], xlist: Iterable[Any], timeout: float | None = None, /
    ) -> tuple[list[Any], list[Any], list[Any]]:
        run = engine()
        if run is None:
            return original(rlist, wlist, xlist, timeout)
        files = list(rlist), list(wlist), list(xlist)
        _wait(run, "a file in select()", timeout, lambda: any(original(*files, 0)))
        return original(*files, 0)

    return select
