"""Marks submissions on the workers of a Dask scheduler, on any number of machines.

Each worker has one submission at a time. So when a worker dies, it is known which submission it had; Dask
itself would blame all that were queued there.
"""

from __future__ import annotations

import contextlib
import itertools
import uuid
from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from queue import Empty, SimpleQueue
from time import monotonic
from typing import TYPE_CHECKING, Any

from grader.marking.errors import DaskPoolError, ResultError
from grader.marking.extras.dask_cluster.on_worker import MARKED, UNFIT, RunSettings, mark_task
from grader.marking.extras.dask_cluster.workers import Workers
from grader.marking.pool import broken_result
from grader.marking.result import Result
from grader.marking.sandbox import ResourceLimits
from grader.marking.task import MarkingTask, TimeLimits

if TYPE_CHECKING:
    from distributed import Client, Future

WAIT_S = 60.0  # for a scheduler, and for a worker
ANSWER_S = 60.0  # for a result that is ready
TICK_S = 0.5  # between checks of the workers
TRIES = 3
LOST = "The worker that marked this was lost."
MISSING = "--dask needs the library distributed, which is not installed: run `make setup`"


@dataclass
class _PendingTask:
    """A submission that is being marked. failed_at: workers where it failed. lost: its worker has gone."""

    task: MarkingTask
    failed: int = 0
    why: str = ""
    failed_at: set[str] = field(default_factory=set)
    address: str = ""
    future: Any = None  # the Future of Dask, once it runs
    lost: bool = False

    def fail(self, why: str) -> None:
        self.failed, self.why = self.failed + 1, why
        self.failed_at.add(self.address)


class DaskPool:
    """Marks on the workers of the scheduler at `address`; a context manager with the interface of Pool.

    unsafe, secret, time_limits, limits: as for Pool. wait_s: seconds to wait for a scheduler that doesn't
    answer and for a worker. Raises DaskPoolError.
    """

    def __init__(
        self,
        address: str,
        unsafe: bool = False,
        secret: str = "",
        time_limits: TimeLimits = TimeLimits(),  # noqa: B008
        limits: ResourceLimits = ResourceLimits(),  # noqa: B008
        wait_s: float = WAIT_S,
    ) -> None:
        self._address, self._wait_s = address, wait_s
        self._how = RunSettings(uuid.uuid4().hex, unsafe, secret, time_limits, limits)
        self._running: dict[str, _PendingTask] = {}  # by their futures' keys
        self._finished: SimpleQueue[Future[Any]] = SimpleQueue()
        self._seen = 0.0  # when a worker was there
        self._client = _connect(address, wait_s)
        self._workers = Workers(self._client)

    def mark(self, tasks: Iterable[MarkingTask]) -> Iterator[Result]:
        """Yield the results in the order in which they are ready. Raises DaskPoolError without workers."""
        fresh = map(_PendingTask, tasks)
        waiting = deque(itertools.islice(fresh, 1))  # one more is read than can be marked
        self._seen = monotonic()
        while waiting or self._running:
            self._assign(waiting, fresh)
            for job in self._wait_for_ended():
                result = self._result(job)
                if result is None:
                    waiting.append(job)
                    continue
                self._assign(waiting, fresh)  # so that no worker waits while the caller takes this result
                began = monotonic()
                yield result
                self._seen += monotonic() - began  # meanwhile nothing looked for workers
            self._check()

    def close(self) -> None:
        """Stop the tasks on the workers, and all processes there."""
        with contextlib.suppress(Exception):  # the scheduler may have gone
            if self._client.status == "running":
                self._client.cancel([job.future for job in self._running.values()])
                self._workers.leave(self._how.run)
        self._client.close()

    def __enter__(self) -> DaskPool:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _present(self) -> set[str] | None:
        """The workers that are connected; None while the scheduler doesn't answer."""
        if self._client.status != "running":
            return None
        try:
            return self._workers.present()
        except (OSError, RuntimeError):  # the connection has ended; the status changes a moment later
            return None

    def _assign(self, waiting: deque[_PendingTask], fresh: Iterator[_PendingTask]) -> None:
        """Cancel the submissions of lost workers, and give one to every free worker."""
        present = self._present()
        if present is None:
            self._seen = monotonic()
            return
        for job in self._running.values():
            if job.address not in present and not job.future.done():
                job.lost = True
                job.future.cancel()
        busy = {job.address for job in self._running.values()}
        for address in sorted(present - busy):
            fitting = (job for job in waiting if address not in job.failed_at or job.failed_at >= present)
            if next_job := next(fitting, None):
                waiting.remove(next_job)
                waiting.extend(itertools.islice(fresh, 1))
                self._start(next_job, address)
        if present or self._running:
            self._seen = monotonic()

    def _start(self, job: _PendingTask, address: str) -> None:
        job.future = self._client.submit(mark_task, self._how, job.task, workers=[address], pure=False)
        job.address, job.lost = address, False
        self._running[job.future.key] = job
        job.future.add_done_callback(self._finished.put)

    def _wait_for_ended(self) -> list[_PendingTask]:
        """The submissions that have ended; waits a moment for the first."""
        ended: list[_PendingTask] = []
        with contextlib.suppress(Empty):
            future = self._finished.get(timeout=TICK_S)
            while True:
                if future.key in self._running:
                    ended.append(self._running.pop(future.key))
                future = self._finished.get_nowait()
        return ended

    def _result(self, job: _PendingTask) -> Result | None:
        """The result of a submission; None if it has to be marked again."""
        from distributed import CancelledError, KilledWorker

        try:
            kind, text = job.future.result(ANSWER_S)
            if kind == MARKED:
                return _read_result(text, job.task)
            if kind == UNFIT:
                self._workers.leave_out(job.address, text)
            else:
                job.fail(text)
        except CancelledError:
            if job.lost:  # otherwise the scheduler was gone for a while
                job.fail(LOST)
        except KilledWorker:
            job.fail(LOST)
        except Exception as error:
            job.fail(f"{type(error).__name__}: {error}")
        return broken_result(job.task, job.why) if job.failed >= TRIES else None

    def _check(self) -> None:
        """Raise DaskPoolError if scheduler or workers have been missing for too long."""
        if self._client.status == "closed":
            raise DaskPoolError(f"the scheduler at {self._address} has not answered for {self._wait_s:g} s")
        if monotonic() - self._seen > self._wait_s:
            start = f"`.venv/bin/dask worker {self._address} --nworkers -1 --nthreads 1` starts some"
            missing = f"no worker of the scheduler at {self._address} could mark anything"
            raise DaskPoolError(f"{missing} for {self._wait_s:g} s: {start}")


def _connect(address: str, wait_s: float) -> Client:
    try:
        from grader.marking.extras.dask_cluster.connection import connect
    except ImportError:
        raise DaskPoolError(MISSING) from None
    try:
        return connect(address, wait_s)
    except (OSError, ValueError, TypeError, RuntimeError) as error:
        what = f"no Dask scheduler answers at {address} ({error})"
        raise DaskPoolError(f"{what}: `.venv/bin/dask scheduler` starts one") from None


def _read_result(text: object, task: MarkingTask) -> Result:
    """Read the result of this task. Raises ResultError for anything else."""
    if not isinstance(text, str):
        raise ResultError(f"expected text, saw {type(text).__name__}")
    result = Result.from_json(text)
    if (result.student, result.assignment, result.key) != (task.student, task.assignment, task.key):
        raise ResultError("this is the result of another submission")
    return result
