"""The scheduler: fibers take turns in a fixed order. When nobody can go on, and only then, time is moved."""

from __future__ import annotations

import contextlib
import os
from _thread import get_ident
from asyncio import _get_running_loop as running_loop
from asyncio import _set_running_loop as set_running_loop
from collections.abc import Callable, Iterator
from typing import Any, NoReturn

import greenlet

from sim.nanoseconds import SECOND, Nanoseconds
from sim.ros.fibers.exceptions import Livelock, RunOver
from sim.ros.fibers.fiber import Fiber, Program

MAX_ROUNDS = 200_000  # of a settle; a run that needs more will never be quiet
# Without a wait between them; more take time, or a busy loop would never end.
FREE_CALLS = {"looks at a clock": 50, "empty spins": 50, "messages": 1_000, "lines": 5_000}
CALL_COST: Nanoseconds = 1_000_000


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
        self, body: Callable[[], Any], name: str, process: Program, *, before: Fiber | None = None
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
        fiber.ready, fiber.wake_at, fiber.waits_for, fiber.spins = ready, until, waits_for, spinning
        if until != self.now:
            fiber.calls.clear()
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

    def called(self, what: str, times: int = 1) -> None:
        """Student code did what a loop may do without end. Often enough, that takes time, as on a robot.

        what: a key of `FREE_CALLS`.
        """
        calls = self.current.calls
        count = calls[what] = calls.get(what, 0) + times
        if count > FREE_CALLS[what]:
            self.loops_busily()
            self.wait("a busy loop", until=self.now + CALL_COST)
            calls[what] = count  # and of the others none: one that takes time is enough

    def loops_busily(self) -> None:
        """The current fiber goes on and on, without a pause in which it would need no processor."""

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
        if not (fiber.busy or fiber.is_asked()):
            fiber.process.steps += 1
        fiber.process.load()
        if fiber.running_loop is not None:
            set_running_loop(fiber.running_loop)
        self.current = fiber
        try:
            fiber.greenlet.switch()
        finally:
            self.current = None
            fiber.running_loop = running_loop()
            if fiber.running_loop is not None:
                set_running_loop(None)
        if fiber.done:
            self.activity += 1
            if fiber in self.fibers:
                self.fibers.remove(fiber)
            self.fiber_ended(fiber)

    def interrupt_all(self) -> None:
        """Do what Ctrl-C does to every program: its main thread is interrupted, and the others are not."""
        self._throw(KeyboardInterrupt, [fiber for fiber in self.fibers if fiber.thread is None])

    def end_all(self) -> None:
        """End what is left; twice, for code that goes on."""
        for _ in range(2):
            self._throw(RunOver, self.fibers)

    def _throw(self, stop: type[BaseException], into: list[Fiber]) -> None:
        for fiber in into:
            if fiber.started:
                fiber.thrown = stop()
            else:
                fiber.done = True
        self.fibers = [fiber for fiber in self.fibers if not fiber.done]
        with contextlib.suppress(Livelock):
            self.settle()

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
