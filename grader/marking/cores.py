"""Where a submission is marked: a judge and a student's process that take turns keep to one core.

On two cores each would wake the other across, at every turn, on a core that may have gone to sleep: the same
run takes a quarter longer.
"""

import contextlib
import os
import queue
from collections.abc import Iterator


def usable() -> list[int]:
    """The cores that this process may run on, by number."""
    return sorted(os.sched_getaffinity(0))


class Cores:
    """A core for each of so many jobs at a time.

    With fewer jobs than cores there is none: another pool on this machine would choose the same ones.
    """

    def __init__(self, jobs: int) -> None:
        here = usable()
        self._free: queue.LifoQueue[int | None] = queue.LifoQueue()
        for job in range(jobs):
            self._free.put(here[job % len(here)] if jobs >= len(here) else None)

    @contextlib.contextmanager
    def one(self) -> Iterator[int | None]:
        """One for the time of a job; None: the kernel may choose."""
        core = self._free.get()
        try:
            yield core
        finally:
            self._free.put(core)
