"""The code of a Dask worker: marks one submission after the other, in a pool of its own.

Nothing in here raises: Dask would write the arguments, and the secret in them, into the worker's log.
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

# Of the code that this process has loaded: a later `git pull` changes only the files.
VERSIONS = versions()
MARKED, FAILED, UNFIT = "marked", "failed", "unfit"  # the last: this machine can't mark anything


@dataclass(frozen=True)
class RunSettings:
    """The settings of one run, which has a name of its own; the others are those of Pool."""

    run: str
    unsafe: bool
    secret: str = field(repr=False)
    time_limits: TimeLimits
    limits: ResourceLimits


class WorkerPool:
    """The pool of this process, for one run at a time."""

    def __init__(self) -> None:
        self._turn = threading.Lock()
        self._run = ""
        self._pool: Pool | None = None
        self._over: set[str] = set()

    def mark(self, how: RunSettings, task: MarkingTask) -> tuple[str, str]:
        """Mark a task of `DaskPool`; returns MARKED and a Result's JSON, or FAILED or UNFIT and why."""
        try:
            with self._turn:
                [result] = self._pool_of(how).mark([task])
                return MARKED, result.to_json()
        except (SandboxMissing, SandboxFailed) as error:
            return UNFIT, str(error)
        except Exception as error:
            return FAILED, f"{type(error).__name__}: {error}"

    def leave(self, run: str) -> None:
        """Stop the tasks of this run, and all its processes."""
        self._over.add(run)
        if self._run == run:
            self.close()

    def close(self) -> None:
        """Kill all processes, also those that are marking."""
        pool, self._run, self._pool = self._pool, "", None
        if pool:
            pool.close()

    def _pool_of(self, how: RunSettings) -> Pool:
        if self._run != how.run:
            self.close()
            self._pool = Pool(1, how.unsafe, how.secret, how.time_limits, how.limits)
            self._run = how.run
        pool = self._pool
        if pool is None or how.run in self._over:  # `leave` was called while the pool was being opened
            self.close()
            raise RuntimeError("the run is over")
        return pool


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
