"""What a Dask worker does: marks one submission after the other, in a pool of its own.

Nothing in here raises: Dask would write the order, and the secret in it, into the worker's log.
"""

from __future__ import annotations

import atexit
import threading
from dataclasses import dataclass, field

from grader.marking.errors import SandboxFailed, SandboxMissing
from grader.marking.pool import Pool
from grader.marking.sandbox import ResourceLimits
from grader.marking.task import MarkingTask, TimeLimits
from grader.marking.version import versions

# As this process has loaded them: a later `git pull` changes the files and not what runs here.
VERSIONS = versions()
MARKED, FAILED, UNFIT = "marked", "failed", "unfit"  # the last: this machine can't mark anything


@dataclass(frozen=True)
class RunSettings:
    """How to mark for one run, which has a name of its own; the rest is as for Pool."""

    run: str
    unsafe: bool
    secret: str = field(repr=False)
    time_limits: TimeLimits
    limits: ResourceLimits


class WorkerPool:
    """The pool of this process, of the run that it marks for."""

    def __init__(self) -> None:
        self._turn = threading.Lock()
        self._run = ""
        self._pool: Pool | None = None
        self._over: set[str] = set()

    def mark(self, how: RunSettings, task: MarkingTask) -> tuple[str, str]:
        """Mark what `DaskPool` ordered: MARKED and a Result's JSON, or FAILED or UNFIT and why."""
        try:
            with self._turn:
                [result] = self._pool_of(how).mark([task])
                return MARKED, result.to_json()
        except (SandboxMissing, SandboxFailed) as error:
            return UNFIT, str(error)
        except Exception as error:
            return FAILED, f"{type(error).__name__}: {error}"

    def leave(self, run: str) -> None:
        """End what is marked for this run, and all its processes."""
        self._over.add(run)
        if self._run == run:
            self.close()

    def close(self) -> None:
        """End all processes, also those at work."""
        pool, self._run, self._pool = self._pool, "", None
        if pool:
            pool.close()

    def _pool_of(self, how: RunSettings) -> Pool:
        if self._run != how.run:
            self.close()
            self._pool = Pool(1, how.unsafe, how.secret, how.time_limits, how.limits)
            self._run = how.run
        if how.run in self._over:  # it was left while the pool was being opened
            self.close()
            raise RuntimeError("the run is over")
        return self._pool


_pool_here = WorkerPool()
atexit.register(_pool_here.close)


def worker_versions() -> dict[str, str]:
    """The versions that mark here; see versions."""
    return VERSIONS


def mark_task(how: RunSettings, task: MarkingTask) -> tuple[str, str]:
    """See WorkerPool.mark."""
    return _pool_here.mark(how, task)


def leave_run(run: str) -> None:
    """See WorkerPool.leave."""
    _pool_here.leave(run)
