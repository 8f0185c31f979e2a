"""Fibers and the scheduler: everything in a run happens on one thread, in one order.

Each student `main()`, thread and parallel callback is a fiber (a greenlet). A fiber runs until it would
wait; then it says what it waits for and hands control back. When nobody can go on, and only then, the
engine moves time.
"""

from __future__ import annotations

import contextlib
import contextvars
import ctypes
import os
import threading
from _thread import get_ident
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, NoReturn

import greenlet

if TYPE_CHECKING:
    from sim.ros.processes import StudentProcess

Nanoseconds = int
SECOND: Nanoseconds = 1_000_000_000

MAX_ROUNDS = 200_000  # of a settle; a run that needs more will never be quiet
FREE_CLOCK_READS = (
    50  # reading a clock is free this often; then it must cost time, or a busy wait would never end
)
CLOCK_READ_COST: Nanoseconds = 1_000_000


def nanoseconds(seconds: float) -> Nanoseconds:
    """A length of time in nanoseconds; what is more than nothing stays more than nothing."""
    return max(round(seconds * SECOND), 1 if seconds > 0 else 0)


class RunOver(BaseException):
    """Thrown into fibers that outlive their run. A BaseException, so that `except Exception` lets it pass."""


class RemoteLost(BaseException):
    """Another process, in which nodes of the run live, is gone, silent, or sends what can't be.

    It ends the run and leaves `sim.run`. A BaseException, so that nobody takes it for a mistake of ours.

    reason: one sentence that says so.
    """

    def __init__(self, reason: str) -> None:
        super().__init__(reason)
        self.reason = reason


class Livelock(BaseException):
    """Callbacks keep calling each other and time never moves."""


class Fiber:
    """One line of execution of a student process."""

    def __init__(
        self, scheduler: Scheduler, body: Callable[[], Any], name: str, process: StudentProcess
    ) -> None:
        self.name, self.process = name, process
        self.done = False
        self.result: Any = None
        self.error: BaseException | None = None
        self.thrown: BaseException | None = None
        self.started = False
        self.daemon = False
        self.thread: threading.Thread | None = None  # the student's thread that it stands for
        self.spins: Any = None  # the executor's plan, while it waits in spin()
        self.callbacks: list[Any] = []  # those on its stack, outermost first
        self.waits_for = ""
        self.ready: Callable[[], bool] | None = None
        self.wake_at: Nanoseconds | None = None
        self.seen_activity: int | None = None
        self.clock_reads = 0
        self._body = body
        self._scheduler = scheduler
        self.greenlet = greenlet.greenlet(self._run, parent=scheduler.hub)
        self.greenlet.gr_context = contextvars.copy_context()

    def _run(self) -> None:
        try:
            self.result = self._body()
        except (RunOver, greenlet.GreenletExit):
            pass
        except BaseException as error:
            self.error = error
        self.done = True

    def runnable(self) -> bool:
        """Whether what it waits for has come."""
        if not self.started or self.thrown is not None:
            return True
        if self.wake_at is not None and self._scheduler.now >= self.wake_at:
            return True
        if self.seen_activity is not None and self.seen_activity != self._scheduler.activity:
            return True
        return self.ready is not None and bool(self.ready())

    def park(self) -> None:
        """Leave this fiber where it is, for ever.

        For code that swallows every exception thrown into it. Freeing its greenlet would throw once more,
        so it is made
        immortal: a small leak instead of a lost kernel. Call only from this fiber's own stack.
        """
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(self.greenlet))
        self.done = True
        self._scheduler.hub.switch()


class Scheduler:
    """Runs fibers in a fixed order until all of them wait. Knows the simulated time, but doesn't move it."""

    def __init__(self) -> None:
        self.now: Nanoseconds = 0
        # Counts what can make an executor's entity ready: what a spinning fiber saw before may be stale.
        self.activity = 0
        # Whether any student code can do that, and not just publish(): as soon as there are services,
        # actions, threads, coroutines or parallel callbacks.
        self.eager = False
        self.switches = 0
        self.livelock: str | None = None
        self.current: Fiber | None = None
        self.fibers: list[Fiber] = []
        self.hub = greenlet.getcurrent()
        self.thread = get_ident()

    def spawn(
        self, body: Callable[[], Any], name: str, process: StudentProcess, *, before: Fiber | None = None
    ) -> Fiber:
        """Add a fiber; it starts when its turn comes, right before `before` if that is given."""
        fiber = Fiber(self, body, name, process)
        index = self.fibers.index(before) if before in self.fibers else len(self.fibers)
        self.fibers.insert(index, fiber)
        self.activity += 1
        return fiber

    def wait(
        self,
        waits_for: str,
        *,
        ready: Callable[[], bool] | None = None,
        until: Nanoseconds | None = None,
        spinning: Any = None,
    ) -> None:
        """Suspend the current fiber until `ready()` is true or time `until` has come.

        spinning: the plan of an executor that it spins; then it goes on whenever anything happened.
        """
        fiber = self.current
        assert fiber is not None, "only a fiber can wait"
        fiber.ready, fiber.wake_at, fiber.waits_for, fiber.clock_reads = ready, until, waits_for, 0
        fiber.spins = spinning
        if spinning is None:
            self.student_code_ran()
        else:
            fiber.seen_activity = self.activity
        self.hub.switch()
        fiber.ready = fiber.wake_at = fiber.seen_activity = fiber.spins = None
        if fiber.thrown is not None:
            error, fiber.thrown = fiber.thrown, None
            raise error

    def student_code_ran(self) -> None:
        """Student code went on for a while, and may have made something ready."""
        if self.eager:
            self.activity += 1

    def clock_was_read(self) -> None:
        """Student code looked at a clock. Often enough, that takes time: else a busy loop would never end."""
        fiber = self.current
        fiber.clock_reads += 1
        if fiber.clock_reads > FREE_CLOCK_READS:
            reads = fiber.clock_reads
            self.wait("a busy loop on a clock", until=self.now + CLOCK_READ_COST)
            fiber.clock_reads = reads

    def refuse_to_go_on(self, why: str) -> NoReturn:
        """Raise Livelock, and keep the reason: student code may swallow the exception."""
        self.livelock = self.livelock or why
        raise Livelock(why)

    def settle(self) -> None:
        """Run fibers until every one of them waits for something that has not come."""
        for _ in range(MAX_ROUNDS):
            if not self.round():
                return
        self.refuse_to_go_on(
            f"the nodes keep each other busy at t = {self.now / SECOND:g} s and time can not move on"
        )

    def round(self) -> bool:
        """Let each fiber that can go on do so once; whether there was one."""
        progressed = False
        for fiber in list(self.fibers):
            if not fiber.done and fiber.runnable():
                self._switch(fiber)
                progressed = True
        return progressed

    def _switch(self, fiber: Fiber) -> None:
        if not fiber.started:
            fiber.started = True
            self.activity += 1
        self.switches += 1
        fiber.process.load()
        self.current = fiber
        try:
            fiber.greenlet.switch()
        finally:
            self.current = None
        if fiber.done:
            self.activity += 1
            if fiber in self.fibers:
                self.fibers.remove(fiber)
            self.fiber_ended(fiber)

    def fiber_ended(self, fiber: Fiber) -> None:
        """Called after a fiber's last step."""


_active: Scheduler | None = None


def activate(scheduler: Scheduler | None) -> None:
    """Make this the one scheduler of the process, or none."""
    global _active
    _active = scheduler


# A child process of student code is no part of the run: there, all hooks are inert.
os.register_at_fork(after_in_child=lambda: activate(None))


def active() -> Scheduler | None:
    """The scheduler of the run in progress."""
    return _active


@contextlib.contextmanager
def outside_student_code() -> Iterator[None]:
    """Let what is called in here be treated as not the student's: it sees real clocks, locks and threads."""
    scheduler = engine()
    if scheduler is None:
        yield
        return
    fiber, scheduler.current = scheduler.current, None
    try:
        yield
    finally:
        scheduler.current = fiber


def engine() -> Any:
    """The engine whose student code is calling, or None: the question that every hook asks first."""
    scheduler = _active
    if scheduler is None or scheduler.current is None or get_ident() != scheduler.thread:
        return None
    return scheduler
