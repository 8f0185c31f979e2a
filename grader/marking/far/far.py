"""Marks submissions on the workers of a Dask scheduler, on any number of machines.

Each worker has one submission at a time. So when one dies, it is known over which; Dask itself would blame
all that waited there.
"""

from __future__ import annotations

import contextlib
import uuid
from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from queue import Empty, SimpleQueue
from time import monotonic
from typing import TYPE_CHECKING

from grader.marking.far.crew import Crew
from grader.marking.far.parcel import pack
from grader.marking.far.worker import MARKED, UNFIT, work
from grader.marking.mending.submission import SUFFIX
from grader.marking.orders import Patience
from grader.marking.plan import Task
from grader.marking.pool import refused
from grader.marking.result import Result, ResultError
from grader.marking.sandbox import Limits

if TYPE_CHECKING:
    from distributed import Client, Future

WAIT_S = 60.0  # for a scheduler, and for a worker
ANSWER_S = 60.0  # for a result that is ready
TICK_S = 0.5  # between looks at who is there
TRIES = 3
LOST = "The worker was lost that marked this."
MISSING = "--dask needs the library distributed, which is not installed: run `make setup`"


class FarError(Exception):
    """Nothing more can be marked there. The text says why, without a full stop."""


@dataclass
class _Job:
    """A submission on its way. been: at which workers it failed. lost: the worker at `address` has gone."""

    task: Task
    failed: int = 0
    why: str = ""
    been: set[str] = field(default_factory=set)
    address: str = ""
    future: Future | None = None
    lost: bool = False

    def fails(self, why: str) -> None:
        self.failed, self.why = self.failed + 1, why
        self.been.add(self.address)


class Far:
    """Marks on the workers of the scheduler at `address`; a context manager with the interface of Pool.

    course: where the tasks' folders are, if they aren't absolute. unsafe, secret, patience, limits: as for
    Pool. wait_s: seconds to wait for a scheduler that doesn't answer and, where there is none, for a worker.
    Raises FarError.
    """

    def __init__(
        self,
        address: str,
        course: Path,
        unsafe: bool = False,
        secret: str = "",
        patience: Patience = Patience(),  # noqa: B008
        limits: Limits = Limits(),  # noqa: B008
        wait_s: float = WAIT_S,
    ) -> None:
        self._address, self._course, self._wait_s = address, course.absolute(), wait_s
        how = {"patience": vars(patience), "limits": asdict(limits)}
        self._order = {"run": uuid.uuid4().hex, "unsafe": unsafe, "secret": secret, **how}
        self._running: dict[str, _Job] = {}  # by their futures' keys
        self._finished: SimpleQueue[Future] = SimpleQueue()
        self._seen = 0.0  # when a worker was there
        self._client = _connected(address, wait_s)
        self._crew = Crew(self._client)

    def mark(self, tasks: Iterable[Task]) -> Iterator[Result]:
        """The results, in the order in which they are ready. Raises FarError when nobody is left to mark."""
        waiting = deque(_Job(self._absolute(task)) for task in tasks)
        self._seen = monotonic()
        while waiting or self._running:
            self._give(waiting)
            for job in self._done():
                result = self._result(job)
                if result is None:
                    waiting.append(job)
                    continue
                self._give(waiting)  # so that no worker waits until this result is filed
                yield result
            self._check()

    def close(self) -> None:
        """End what is marked at the workers, and all processes there."""
        with contextlib.suppress(Exception):  # nobody may be there any more
            if self._client.status == "running":
                self._client.cancel([job.future for job in self._running.values()])
                self._crew.leave(self._order["run"])
        self._client.close()

    def __enter__(self) -> Far:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _absolute(self, task: Task) -> Task:
        return replace(task, folder=self._course / task.folder, release=self._course / task.release)

    def _there(self) -> set[str] | None:
        """The workers that are there; None while the scheduler doesn't answer."""
        if self._client.status != "running":
            return None
        try:
            return self._crew.there()
        except (OSError, RuntimeError):  # so ends a connection, and the status says it a moment later
            return None

    def _give(self, waiting: deque[_Job]) -> None:
        """Take back what a worker had that is gone, and give every free one something to do."""
        there = self._there()
        if there is None:
            self._seen = monotonic()
            return
        for job in self._running.values():
            if job.address not in there and not job.future.done():
                job.lost = True
                job.future.cancel()
        busy = {job.address for job in self._running.values()}
        for address in sorted(there - busy):
            job = next((job for job in waiting if address not in job.been or job.been >= there), None)
            if job:
                waiting.remove(job)
                self._start(job, address)
        if there or self._running:
            self._seen = monotonic()

    def _start(self, job: _Job, address: str) -> None:
        task = job.task
        about = {"student": task.student, "assignment": task.assignment, "key": task.key}
        folders = {"submission": pack(task.folder, SUFFIX), "release": pack(task.release)}
        order = self._order | folders | {"task": about}
        job.future = self._client.submit(work, order, workers=[address], pure=False)
        job.address, job.lost = address, False
        self._running[job.future.key] = job
        job.future.add_done_callback(self._finished.put)

    def _done(self) -> list[_Job]:
        """What has come to an end; waits a moment for the first."""
        ended: list[_Job] = []
        with contextlib.suppress(Empty):
            future = self._finished.get(timeout=TICK_S)
            while True:
                if future.key in self._running:
                    ended.append(self._running.pop(future.key))
                future = self._finished.get_nowait()
        return ended

    def _result(self, job: _Job) -> Result | None:
        """The result of a submission; None if it has to be marked again."""
        from distributed import CancelledError, KilledWorker

        try:
            kind, text = job.future.result(ANSWER_S)
            if kind == MARKED:
                return _checked(text, job.task)
            if kind == UNFIT:
                self._crew.leave_out(job.address, text)
            else:
                job.fails(text)
        except CancelledError:
            if job.lost:  # otherwise the scheduler was gone for a while
                job.fails(LOST)
        except KilledWorker:
            job.fails(LOST)
        except Exception as error:
            job.fails(f"{type(error).__name__}: {error}")
        return refused(job.task, job.why) if job.failed >= TRIES else None

    def _check(self) -> None:
        """Raise FarError if it is time to give up."""
        if self._client.status == "closed":
            raise FarError(f"the scheduler at {self._address} has not answered for {self._wait_s:g} s")
        if monotonic() - self._seen > self._wait_s:
            start = f"`.venv/bin/dask worker {self._address} --nworkers -1 --nthreads 1` starts some"
            nobody = f"no worker of the scheduler at {self._address} could mark anything"
            raise FarError(f"{nobody} for {self._wait_s:g} s: {start}")


def _connected(address: str, wait_s: float) -> Client:
    try:
        from grader.marking.far.connection import connect
    except ImportError:
        raise FarError(MISSING) from None
    try:
        return connect(address, wait_s)
    except (OSError, ValueError, TypeError, RuntimeError) as error:
        what = f"no Dask scheduler answers at {address} ({error})"
        raise FarError(f"{what}: `.venv/bin/dask scheduler` starts one") from None


def _checked(text: object, task: Task) -> Result:
    """Raises ResultError unless it is a result of this task."""
    if not isinstance(text, str):
        raise ResultError(f"expected text, saw {type(text).__name__}")
    result = Result.from_json(text)
    if (result.student, result.assignment, result.key) != (task.student, task.assignment, task.key):
        raise ResultError("this is the result of another submission")
    return result
