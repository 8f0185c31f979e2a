"""asyncio's event loops wait in simulated time, and other fibers go on meanwhile."""

from __future__ import annotations

import selectors
from collections.abc import Callable
from typing import Any

from sim.nanoseconds import nanoseconds
from sim.ros.fibers.scheduler import engine
from sim.ros.hooks.table import hook


@hook(selectors.DefaultSelector, "select", "event loops wait in it, for wall time, and no fiber could go on")
def select(original: Callable) -> Callable:
    def select(self: selectors.BaseSelector, timeout: float | None = None) -> list[Any]:
        run = engine()
        if run is None:
            return original(self, timeout)
        run.eager = True
        ready = original(self, 0)
        if ready or (timeout is not None and timeout <= 0):
            return ready
        until = None if timeout is None else run.now + nanoseconds(timeout)
        # Another fiber's call_soon_threadsafe() writes to a socket that the selector watches.
        run.wait("an event in asyncio's loop", ready=lambda: original(self, 0), until=until)
        return original(self, 0)

    return select
