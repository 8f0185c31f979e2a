"""Pins a submission's processes to one core: a judge and a student's process that take turns.

On two cores each would wake the other at every turn, on a core that may be in a sleep state: the same run
takes a quarter longer.
"""

import contextlib
import os
import queue
from collections.abc import Iterator


def usable_cores() -> list[int]:
    """The cores that this process may run on, by number."""
    return sorted(os.sched_getaffinity(0))


class Cores:
    """Assigns cores to so many jobs at a time.

    With fewer jobs than cores it assigns none: another pool on this machine would choose the same ones.
    """

    def __init__(self, jobs: int) -> None:
        here = usable_cores()
        self._free: queue.LifoQueue[int | None] = queue.LifoQueue()
        for job in range(jobs):
            self._free.put(here[job % len(here)] if jobs >= len(here) else None)

    @contextlib.contextmanager
    def one(self) -> Iterator[int | None]:
        """A core for the duration of a job; None if the kernel may choose."""
        core = self._free.get()
        try:
            yield core
        finally:
            self._free.put(core)
