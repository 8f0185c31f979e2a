"""The guard: student code that never returns control is stopped, and the kernel lives on.

A timer signal checks four times a second. If the same stretch of student code has run since, and has used
too much computing time, or waited too long in a call that the hooks don't reach, an exception is raised in
it. Code that swallows even that is parked. A loop that polls what others of its program do works on a robot,
and waits for them here. So that a busy machine changes no result, computing time is what is measured, and
wall time doesn't pass while the thread is ready to run and no core is free.
"""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from time import monotonic, thread_time
from types import CodeType, FrameType
from typing import NoReturn

import greenlet

from sim.nanoseconds import SECOND
from sim.ros.engine.limits import RunLimits
from sim.ros.fibers.exceptions import Hang
from sim.ros.fibers.fiber import Fiber
from sim.ros.fibers.scheduler import Scheduler, outside_student_code
from sim.ros.recorder.recorder import Recorder
from sim.ros.recorder.tracebacks import is_library, student_line

CHECK_EVERY = 0.25  # s of wall time
COMPUTING_LIMIT = 2.0  # s of computing time in one stretch
WAITING_LIMIT = 10.0  # s of wall time in one stretch in which nothing was computed
TOTAL_LIMIT = 20.0  # s of computing time in a whole run, or as long as the run simulates if that is longer
SECOND_LIMIT = 100.0  # s of wall time for one simulated second, far more than any busy machine needs
BUSY_CHECK = 0.01  # s of computing in which a busy loop sees what others have done, and ends
BUSY_TRIES = 100  # checks of a busy loop until it is found in the student's own code
IDLE = 0.001  # s of computing time between two checks; more is no waiting, however busy the machine

SCHEDULING = "/proc/thread-self/schedstat"

# What must not be interrupted: the course's own code, and imports, which hold a real lock.
UNINTERRUPTIBLE = str(Path(__file__).parents[2]), "<frozen "


def _can_switch(frame: FrameType | None) -> bool:
    """Return whether other fibers may run while student code is there, in its own code or in a library's."""
    while frame is not None and is_library(frame.f_code.co_filename):
        if frame.f_code.co_filename.startswith(UNINTERRUPTIBLE):
            return False
        frame = frame.f_back
    return frame is not None


def wall_time() -> float:
    """Seconds of wall time in which this thread could have run; only their differences have a meaning."""
    try:
        file = os.open(SCHEDULING, os.O_RDONLY)
    except OSError:  # a kernel without these statistics
        return monotonic()
    try:
        _, queued, _ = os.read(file, 100).split()  # proc(5): ns on a core, ns in the queue for one, turns
    finally:
        os.close(file)
    return monotonic() - int(queued) / SECOND


class Guard:
    """Watches one run while it executes student code. Needs the main thread; elsewhere it does nothing."""

    def __init__(self, scheduler: Scheduler, recorder: Recorder, limits: RunLimits) -> None:
        self._scheduler, self._recorder, self._limits = scheduler, recorder, limits
        self.interrupted = False
        self.hang: Hang | None = None
        self.impatient = False  # while the run is taken down, student code gets less time
        self._stretch = -1
        self._busy, self._tries = False, 0  # whether the stretch continues a busy loop
        self._known: set[CodeType] = set()  # where there were such loops
        self._computing = self._waiting = self._total = 0.0
        self._second, self._wall = 0, 0.0  # the simulated second under way, and the wall time that it took
        self._total_limit = max(TOTAL_LIMIT, recorder.recording.seconds)
        self._seen = self._left = thread_time()
        self._checked = wall_time()
        self._next_check = CHECK_EVERY
        self._raised = 0

    @contextlib.contextmanager
    def watch(self) -> Iterator[None]:
        """Install the signal handlers for this block. What happens between two blocks doesn't count."""
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        self._seen += thread_time() - self._left
        self._checked = wall_time()
        interrupt = signal.signal(signal.SIGINT, self._on_interrupt)
        users_timer = signal.setitimer(signal.ITIMER_REAL, 0)  # first: its alarm is not for this guard
        alarm = signal.signal(signal.SIGALRM, self._check)
        signal.setitimer(signal.ITIMER_REAL, self._next_check, CHECK_EVERY)
        try:
            yield
        finally:
            self._next_check = signal.setitimer(signal.ITIMER_REAL, 0)[0] or CHECK_EVERY
            signal.signal(signal.SIGALRM, alarm)
            signal.signal(signal.SIGINT, interrupt)
            signal.setitimer(signal.ITIMER_REAL, *users_timer)
            self._left = thread_time()

    def _on_interrupt(self, number: int, frame: FrameType | None) -> None:
        self.interrupted = True
        if self._student_code(frame) is not None:
            raise KeyboardInterrupt  # what a program on a robot gets

    @property
    def waiting_limit(self) -> float:
        """Return how long, in seconds of wall time, a stretch of student code may wait without computing."""
        return (0.1 if self.impatient or self.interrupted else 1.0) * WAITING_LIMIT

    def waited(self, what: str) -> NoReturn:
        """The current fiber has waited for that as long as it may: raise Hang in it."""
        fiber = self._scheduler.current
        with outside_student_code():
            line = student_line(sys._getframe(1))
            self.hang = self.hang or Hang(
                f"{self._where(fiber)} waited for {WAITING_LIMIT:g} s of real time for {what}{line}."
            )
        raise self.hang

    def _student_code(self, frame: FrameType | None) -> Fiber | None:
        """The fiber that the signal came into; None while the hub runs, or at a fiber's own begin or end.

        What is raised there would leave the run, as nothing catches it.
        """
        outside = greenlet.getcurrent() is self._scheduler.hub
        outside |= frame is not None and frame.f_code is Fiber._run.__code__
        return None if outside else self._scheduler.current

    def _where(self, fiber: Fiber) -> str:
        now = self._recorder.now
        if fiber.callbacks:
            running = fiber.callbacks[-1]
            return f"{running.name} of node {running.node} at t = {now:g} s"
        return f"{fiber.name}() at t = {now:g} s"

    def _check(self, number: int, frame: FrameType | None) -> None:
        fiber, stretch, computed = self._student_code(frame), self._work(), self._computed()
        now = wall_time()
        # No more than the interval: a machine that was suspended has not waited.
        passed, self._checked = min(max(now - self._checked, 0.0), CHECK_EVERY), now
        second = self._scheduler.now // SECOND
        self._second, self._wall = second, passed + (self._wall if second == self._second else 0.0)
        if fiber is None or stretch != self._stretch:
            self._begin_stretch(stretch)
        else:
            self._computing += computed
            self._waiting += passed if computed < IDLE else 0.0
        if fiber is not None:
            self._judge(fiber, frame)

    def _computed(self) -> float:
        """Computing time since the last call."""
        seen, self._seen = self._seen, thread_time()
        self._total += self._seen - seen
        return self._seen - seen

    def _work(self) -> int:
        """Changes whenever control passes on. Sending counts, too: too much of that ends by its number."""
        return self._limits.work + self._recorder.sent

    def _begin_stretch(self, stretch: int, busy: bool = False) -> None:
        self._stretch, self._raised = stretch, 0
        self._busy, self._tries = busy, 0
        self._computing = self._waiting = 0.0
        if busy:
            self._check_soon()

    def _check_soon(self) -> None:
        signal.setitimer(signal.ITIMER_REAL, BUSY_CHECK, CHECK_EVERY)

    def _judge(self, fiber: Fiber, frame: FrameType | None) -> None:
        limit = self.waiting_limit
        stuck = self._computing >= COMPUTING_LIMIT * limit / WAITING_LIMIT or self._waiting >= limit
        long = self._total >= self._total_limit or self._wall >= SECOND_LIMIT
        if not long and self._can_wait(fiber, frame):
            return
        if not stuck and (not long or self.impatient):
            return
        self._raised += 1
        if self.hang is None:
            with outside_student_code():
                self.hang = Hang(self._describe(fiber, frame, stuck))
        if self._raised > 2:
            fiber.park()
        raise self.hang

    def _can_wait(self, fiber: Fiber, frame: FrameType | None) -> bool:
        """Return whether it may be a busy loop that polls others. If so, it waits until they have run."""
        scheduler, program = self._scheduler, fiber.process
        others = [other for other in scheduler.fibers if other.process is program and other is not fiber]
        ends = self.hang is not None or self.impatient or self.interrupted or self._tries > BUSY_TRIES
        if not others or ends or self._waiting >= WAITING_LIMIT:
            return False
        known = frame is not None and frame.f_code in self._known
        if self._computing < (BUSY_CHECK if self._busy or known else COMPUTING_LIMIT):
            if self._busy:
                self._check_soon()
            return self._busy
        if not _can_switch(frame):
            self._tries += 1
            self._check_soon()
            return True
        self._known.add(frame.f_code)
        scheduler.busy_loop_found()
        steps, calls = program.steps, dict(fiber.calls)
        fiber.busy = True
        try:
            scheduler.wait("others to go on", ready=lambda: program.steps != steps)
        finally:
            fiber.busy = False
        fiber.calls.update(calls)
        self._computed()
        self._begin_stretch(self._work(), busy=True)
        return True

    def _describe(self, fiber: Fiber, frame: FrameType | None, stuck: bool) -> str:
        where, line = self._where(fiber), student_line(frame)
        if not stuck and self._total < self._total_limit:
            taken = f"One simulated second took {SECOND_LIMIT:g} s of real time"
            return f"{taken}; the nodes were stopped in {where}{line}."
        if not stuck:
            limit = self._total_limit
            return f"The nodes computed for {limit:g} s in all, and were stopped in {where}{line}."
        if self._computing >= COMPUTING_LIMIT:
            return f"{where} computed for {COMPUTING_LIMIT:g} s without finishing{line}."
        return f"{where} waited for {WAITING_LIMIT:g} s in a call that simulated time can't shorten{line}."
