"""Marks submissions in processes of their own, several at a time.

Two warm processes live as long as the pool: one forks a judge for each submission, the other, in its sandbox,
a student's process for each notebook. A third is started for the first package: in a sandbox of its own it
forks a process for each build. In the marker's own process no code of a submission is run.
"""

from __future__ import annotations

import contextlib
import itertools
import socket
import threading
from collections.abc import Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import replace
from time import monotonic

from grader.marking.build_process import builder
from grader.marking.cores import Cores
from grader.marking.errors import NotMarked, ResultError, SandboxFailed
from grader.marking.result import Result
from grader.marking.sandbox import ConfinedProcess, ResourceLimits, Sandbox
from grader.marking.student_process import judge_only
from grader.marking.task import MAX_RESULT_BYTES, JudgeOrder, MarkingTask, TimeLimits, send_order
from sim.ros.remote import Wire, WireError, WireTimeout

PRELOAD = ("grader.marking.preload",)
JUDGE_ENTRY = "grader.marking.judge.judge_process:main"
JUDGE = ResourceLimits(memory_mb=4000, cpu_s=1800, wall_s=3600, file_mb=256)
SPARE_S = 120.0  # that a submission may take besides its notebooks
BUILD_S = 480.0  # more for each package, including the start of its sandbox
END_S = 20.0  # for a process that has closed its connection to end
TRIES = 2


class Pool:
    """Marks `jobs` submissions at a time; a context manager, which leaves no process behind.

    unsafe: students' code runs without a sandbox; see Sandbox. secret: private worlds and seeds are derived
    from it; "" for the public ones. time_limits, limits: what a submission may use. Raises SandboxMissing and
    SandboxFailed.
    """

    def __init__(
        self,
        jobs: int,
        unsafe: bool = False,
        secret: str = "",
        time_limits: TimeLimits = TimeLimits(),  # noqa: B008
        limits: ResourceLimits = ResourceLimits(),  # noqa: B008
    ) -> None:
        self._jobs, self._secret, self._time_limits = jobs, secret, time_limits
        self._cores = Cores(jobs)
        self._running: set[ConfinedProcess] = set()
        self._closed = False
        self._unsafe, self._lock = unsafe, threading.Lock()
        self._builders: Sandbox | None = None
        with contextlib.ExitStack() as stack:
            # The kernel kills a warm process with the thread that started it: these live as long as the pool.
            self._threads = ThreadPoolExecutor(max(jobs, 2), "mark")
            stack.callback(self._threads.shutdown, cancel_futures=True)
            judges = self._threads.submit(Sandbox, JUDGE_ENTRY, PRELOAD, unsafe=True, limits=JUDGE)
            students = self._threads.submit(
                Sandbox, preload=PRELOAD, unsafe=unsafe, limits=limits, hidden=judge_only.FOLDERS
            )
            self._judges = stack.enter_context(judges.result())
            self._students = stack.enter_context(students.result())
            stack.callback(self._stop)
            self._stack = stack.pop_all()

    @property
    def isolation(self) -> str:
        """Return how students' code is kept from the judge, as `Sandbox.isolation` does."""
        return self._students.isolation

    def mark(self, tasks: Iterable[MarkingTask]) -> Iterator[Result]:
        """Yield the results, in the order in which they are ready. No submission makes it raise."""
        left = iter(tasks)
        running = self._submit(left, self._jobs)
        while running:
            done, running = wait(running, return_when=FIRST_COMPLETED)
            running |= self._submit(left, len(done))  # first: the caller takes time for each result
            yield from (future.result() for future in done)

    def _submit(self, left: Iterator[MarkingTask], count: int) -> set[Future[Result]]:
        return {self._threads.submit(self._mark, task) for task in itertools.islice(left, count)}

    def close(self) -> None:
        """End all processes, also those at work."""
        self._stack.close()

    def __enter__(self) -> Pool:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _stop(self) -> None:
        with self._lock:
            self._closed = True
            if self._builders is not None:
                self._builders.close()
        for process in list(self._running):
            process.kill()

    def _building(self) -> Sandbox:
        """The sandbox for builds; made for the first one, by a thread that lives as long as the pool."""
        with self._lock:
            if self._closed:
                raise NotMarked("The marking was stopped.")
            if self._builders is None:
                limits, hidden, unsafe = builder.LIMITS, judge_only.FOLDERS, self._unsafe
                start = builder.ENTRY, builder.PRELOAD
                self._builders = Sandbox(*start, unsafe=unsafe, limits=limits, hidden=hidden)
            return self._builders

    def _mark(self, task: MarkingTask) -> Result:
        why = ""
        for _ in range(TRIES):
            try:
                return self._mark_once(task)
            except (NotMarked, SandboxFailed) as reason:
                why = str(reason)
            if self._closed:
                break
        return broken_result(task, why)

    def _mark_once(self, task: MarkingTask) -> Result:
        """Mark in new processes. Raises NotMarked and SandboxFailed."""
        with contextlib.ExitStack() as stack:
            core = stack.enter_context(self._cores.one())
            sock, judge = self._start(self._judges, stack, core)
            wire = Wire(sock, MAX_RESULT_BYTES)
            deadline = monotonic() + self._longest(task)
            students: list[ConfinedProcess] = []
            builders: list[ConfinedProcess] = []
            try:
                send_order(sock, JudgeOrder(task, self._secret, self._time_limits))
                while True:
                    match wire.receive(max(deadline - monotonic(), 0.001)):
                        case {"student": True}:
                            for earlier in students:
                                earlier.kill()  # it may still use memory, or hang
                            student, process = self._start(self._students, stack, core)
                            students.append(process)
                            socket.send_fds(sock, [b"."], [student.fileno()])
                            student.close()
                        case {"build": True}:
                            child_end, process = self._start(self._building(), stack, None)
                            builders.append(process)
                            deadline += BUILD_S
                            socket.send_fds(sock, [b"."], [child_end.fileno()])
                            child_end.close()
                        case {"ending": "student"}:
                            wire.send(ending=_ending(students[-1]))
                        case {"ending": "build"}:
                            wire.send(ending=_ending(builders[-1]))
                        case {"result": text}:
                            return _with_use(Result.from_json(text), judge, students, builders)
                        case {"failed": why}:
                            raise NotMarked(why)
            except WireTimeout:
                raise NotMarked(f"It took more than {self._longest(task):g} s.") from None
            except (WireError, OSError):
                raise NotMarked(f"The judge's process ended unexpectedly. {_ending(judge)}") from None
            except ResultError as error:
                raise NotMarked(f"The judge returned no result: {error}") from None

    def _longest(self, task: MarkingTask) -> float:
        return SPARE_S + len(task.release.notebooks) * (self._time_limits.start + self._time_limits.notebook)

    def _start(
        self, sandbox: Sandbox, stack: contextlib.ExitStack, core: int | None
    ) -> tuple[socket.socket, ConfinedProcess]:
        """A new process and the socket to it, both until the stack is closed. core: pins it, if given."""
        parent_end, child_end = socket.socketpair()
        stack.enter_context(parent_end)
        process = sandbox.start(child_end)
        if core is not None:
            process.keep_to(core)
        stack.callback(self._end, process)
        self._running.add(process)
        if self._closed:
            raise NotMarked("The marking was stopped.")
        return parent_end, process

    def _end(self, process: ConfinedProcess) -> None:
        process.kill()
        process.wait()
        self._running.discard(process)


def broken_result(task: MarkingTask, why: str) -> Result:
    """The result of a submission that could not be marked, perhaps through no fault of the student's."""
    return Result(task.student, task.assignment, task.key, "broken", why)


def _ending(process: ConfinedProcess) -> str:
    """Return how a process ended that has closed its connection, as a sentence; "" if it hasn't ended."""
    try:
        return process.wait(END_S).detail
    except TimeoutError:
        return ""


def _with_use(
    result: Result, judge: ConfinedProcess, students: list[ConfinedProcess], builders: list[ConfinedProcess]
) -> Result:
    """The result with the usage of its processes: CPU seconds, and the student's peak memory in MB."""
    processes = (judge, *students, *builders)
    for process in processes:
        process.kill()  # a student's may still be in a cell that ignores interrupts
    computing = sum(process.wait().cpu_s for process in processes)
    memory = max((student.memory() for student in students), default=0.0)
    return replace(result, timings=result.timings | {"computing": computing, "memory": memory})
