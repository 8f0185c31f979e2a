"""Marks submissions in processes of their own, some at a time.

Two warm processes stay: one forks a judge for each submission, the other, in its cage, a student's process
for each notebook. Here in the marker's process nothing of a submission is run.
"""

from __future__ import annotations

import contextlib
import itertools
import socket
from collections.abc import Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import replace
from pathlib import Path
from time import monotonic

from grader.marking.orders import RESULT, Patience, given
from grader.marking.plan import Task
from grader.marking.result import Result, ResultError
from grader.marking.sandbox import Inmate, Limits, Sandbox, SandboxFailed
from sim.ros.remote import Wire, WireError, WireTimeout

WARM = ("grader.marking.warm",)
JUDGE = Limits(memory_mb=4000, cpu_s=1800, wall_s=3600, file_mb=256)
SPARE_S = 120.0  # that a submission may take beside its notebooks
END_S = 5.0  # for a process that has hung up to be gone
TRIES = 2


class Failed(Exception):
    """A submission could not be marked. The text says what happened."""


class Pool:
    """Marks with `jobs` submissions at a time; a context manager, which leaves no process behind.

    course: where the tasks' folders are, if they aren't absolute. unsafe: students' code runs without a cage;
    see Sandbox. secret: where private worlds and seeds come from; "" for the public ones. patience, limits:
    what a submission may take. Raises SandboxMissing and SandboxFailed.
    """

    def __init__(
        self,
        course: Path,
        jobs: int,
        unsafe: bool = False,
        secret: str = "",
        patience: Patience = Patience(),  # noqa: B008
        limits: Limits = Limits(),  # noqa: B008
    ) -> None:
        self._course, self._jobs = course.absolute(), jobs
        self._secret, self._patience = secret, patience
        self._running: set[Inmate] = set()
        self._closed = False
        with contextlib.ExitStack() as stack:
            # The kernel ends a warm process with the thread that started it: these live as long as the pool.
            self._threads = ThreadPoolExecutor(max(jobs, 2), "mark")
            stack.callback(self._threads.shutdown, cancel_futures=True)
            court = "grader.marking.court.clerk:main"
            judges = self._threads.submit(Sandbox, court, WARM, unsafe=True, limits=JUDGE)
            pupils = self._threads.submit(Sandbox, preload=WARM, unsafe=unsafe, limits=limits)
            self._judges = stack.enter_context(judges.result())
            self._pupils = stack.enter_context(pupils.result())
            stack.callback(self._stop)
            self._stack = stack.pop_all()

    def mark(self, tasks: Iterable[Task]) -> Iterator[Result]:
        """The results, in the order in which they are ready. Raises nothing for a submission's sake."""
        left = iter(tasks)
        running = self._more(left, self._jobs)
        while running:
            done, running = wait(running, return_when=FIRST_COMPLETED)
            running |= self._more(left, len(done))  # first: to file a result takes its time
            yield from (future.result() for future in done)

    def _more(self, left: Iterator[Task], count: int) -> set[Future[Result]]:
        return {self._threads.submit(self._mark, task) for task in itertools.islice(left, count)}

    def close(self) -> None:
        """End all processes, also those at work."""
        self._stack.close()

    def __enter__(self) -> Pool:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _stop(self) -> None:
        self._closed = True
        for process in list(self._running):
            process.kill()

    def _mark(self, task: Task) -> Result:
        why = ""
        for _ in range(TRIES):
            try:
                return self._once(task)
            except (Failed, SandboxFailed) as reason:
                why = str(reason)
            if self._closed:
                break
        return refused(task, why)

    def _once(self, task: Task) -> Result:
        """Mark in fresh processes. Raises Failed and SandboxFailed."""
        task = replace(task, folder=self._course / task.folder, release=self._course / task.release)
        with contextlib.ExitStack() as stack:
            sock, judge = self._started(self._judges, stack)
            wire = Wire(sock, RESULT)
            deadline = monotonic() + self._longest(task)
            pupils: list[Inmate] = []
            try:
                wire.send(**given(task, self._secret, self._patience))
                while True:
                    match wire.receive(max(deadline - monotonic(), 0.001)):
                        case {"pupil": True}:
                            pupil, inmate = self._started(self._pupils, stack)
                            pupils.append(inmate)
                            socket.send_fds(sock, [b"."], [pupil.fileno()])
                            pupil.close()
                        case {"ending": True}:
                            wire.send(ending=_ending(pupils[-1]))
                        case {"result": text}:
                            return _with_use(Result.from_json(text), judge, pupils)
                        case {"failed": why}:
                            raise Failed(why)
            except WireTimeout:
                raise Failed(f"It took more than {self._longest(task):g} s.") from None
            except (WireError, OSError):
                raise Failed(f"The judge's process broke off. {_ending(judge)}") from None
            except ResultError as error:
                raise Failed(f"The judge gave no result: {error}") from None

    def _longest(self, task: Task) -> float:
        notebooks = len(list(task.release.glob("*.ipynb")))
        return SPARE_S + notebooks * (self._patience.start + self._patience.notebook)

    def _started(self, sandbox: Sandbox, stack: contextlib.ExitStack) -> tuple[socket.socket, Inmate]:
        """A new process, and the socket to it; both are gone when the stack is."""
        ours, theirs = socket.socketpair()
        stack.enter_context(ours)
        inmate = sandbox.start(theirs)
        stack.callback(self._end, inmate)
        self._running.add(inmate)
        if self._closed:
            raise Failed("The marking was stopped.")
        return ours, inmate

    def _end(self, process: Inmate) -> None:
        process.kill()
        process.wait()
        self._running.discard(process)


def refused(task: Task, why: str) -> Result:
    """The result of a submission that could not be marked, for no fault that anybody knows of."""
    words = "This could not be marked; your instructor will look at it."
    return Result(task.student, task.assignment, task.key, "refused", f"{words} {why}", flags=[why])


def _ending(process: Inmate) -> str:
    """How a process ended that has hung up, as a sentence; "" if it hasn't ended."""
    try:
        return process.wait(END_S).detail
    except TimeoutError:
        return ""


def _with_use(result: Result, judge: Inmate, pupils: list[Inmate]) -> Result:
    """The result with what its processes used: seconds of computing, and memory of the student's, in MB."""
    processes = (judge, *pupils)
    for process in processes:
        process.kill()  # a student's may still be in a cell that nobody could interrupt
    computing = sum(process.wait().cpu_s for process in processes)
    memory = max((pupil.memory() for pupil in pupils), default=0.0)
    return replace(result, timings=result.timings | {"computing": computing, "memory": memory})
