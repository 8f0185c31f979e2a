"""The scheduler: fibers take turns in a fixed order. The engine moves time, when none can go on."""

from __future__ import annotations

import contextlib
import os
from _thread import get_ident
from asyncio import _get_running_loop as running_loop
from asyncio import _set_running_loop as set_running_loop
from collections.abc import Callable, Iterator
from typing import Any, NoReturn

import greenlet

from sim.nanoseconds import EPOCH, Nanoseconds
from sim.ros.fibers.choices import Choices
from sim.ros.fibers.exceptions import Livelock
from sim.ros.fibers.fiber import Fiber, Program
from sim.ros.fibers.waiter import NEVER, Waiter, Waiters

# Without a wait between them; more take time, or a busy loop would never end.
FREE_CALLS = {"looks at a clock": 50, "empty spins": 50, "messages": 1_000, "lines": 5_000}
CALL_COST: Nanoseconds = 1_000_000


class Scheduler:
    """Runs fibers in a fixed order until all of them wait. Knows the simulated time, but doesn't move it."""

    def __init__(self) -> None:
        self.now: Nanoseconds = 0
        self.epoch: Nanoseconds = EPOCH  # what clocks show at the start of the run
        self.waiters = Waiters()
        self.choices: Choices | None = None  # None in the usual order
        self.preemption: Any = None  # None where no thread is preempted
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
        fiber.number = process.fibers_started
        process.fibers_started += 1
        process.fibers_alive += 1
        if self.preemption is not None and process.fibers_alive > 1 and not process.from_course:
            self.preemption.thread_started()
        index = self.fibers.index(before) if before in self.fibers else len(self.fibers)
        self.fibers.insert(index, fiber)
        return fiber

    # -- what a fiber calls ------------------------------------------------------------------------

    def wait(
        self,
        waits_for: str,
        *,
        ready: Callable[[], bool] | None = None,
        until: Nanoseconds | None = None,
        spinning: Waiter | None = None,
    ) -> None:
        """Suspend the current fiber until `ready()` is true or the time is `until`.

        spinning: the executor that it spins; it continues when that is woken, or one of its timers is due.
        """
        fiber = self.current
        assert fiber is not None, "only a fiber can wait"
        fiber.ready, fiber.wake_at, fiber.waits_for, fiber.waiter = ready, until, waits_for, spinning
        if until != self.now:
            fiber.calls.clear()
        if spinning is None:
            self.student_code_ran()
        else:
            fiber.seen_wakes, fiber.timer_due = spinning.wakes, NEVER
        self.hub.switch()
        fiber.ready = fiber.wake_at = fiber.waiter = None
        if fiber.thrown is not None:
            error, fiber.thrown = fiber.thrown, None
            raise error

    def preemption_point(self, function: str, line: int) -> bool:
        """The current fiber is about to execute this line of a student's function: it may have to wait.

        Returns whether it had to.
        """
        preempted = self.choices.preemption(self.current, function, line, self.others_due)
        if preempted is None:
            return False
        program, begin = self.current.process, self.now
        steps = program.steps + 1  # others have taken one

        def is_over() -> bool:
            return self.now >= begin + preempted.wait and (not preempted.patience or program.steps >= steps)

        self.wait("its turn", ready=is_over, until=begin + max(preempted.wait, preempted.patience))
        return True

    def others_due(self, within: Nanoseconds) -> bool:
        """Return whether anything but the current fiber goes on within this time."""
        moment = self.now + within
        others = (fiber for fiber in self.fibers if fiber is not self.current and not fiber.done)
        return any(fiber.runnable() or fiber.next_due() <= moment for fiber in others)

    def wake_all(self) -> None:
        """Something happened that may concern any executor: let each that is waiting look for work."""
        self.waiters.wake_all()

    def student_code_ran(self) -> None:
        """Code of a program ran for a while, and may have made work ready that only polling finds."""
        if self.waiters.polled:
            self.waiters.wake_polled()

    def count_call(self, what: str, times: int = 1) -> None:
        """Student code did what a loop may do without end. Often enough, that takes time, as on a robot.

        what: a key of `FREE_CALLS`.
        """
        calls = self.current.calls
        count = calls[what] = calls.get(what, 0) + times
        if count > FREE_CALLS[what]:
            self.busy_loop_found()
            self.wait("a busy loop", until=self.now + CALL_COST)
            calls[what] = count  # and of the others none: one that takes time is enough

    def busy_loop_found(self) -> None:
        """The current fiber loops without a pause in which it would need no processor."""

    def raise_livelock(self, why: str) -> NoReturn:
        """Raise Livelock, and store the reason: student code may swallow the exception."""
        self.livelock = self.livelock or why
        raise Livelock(why)

    # -- what the main loop calls ------------------------------------------------------------------

    def turn_order(self) -> list[Fiber]:
        """The fibers in the order of their turns in a round: usually that of their creation."""
        return list(self.fibers) if self.choices is None else self.choices.turns(self.fibers)

    def run_round(self) -> bool:
        """Give each fiber that can go on one turn; whether there was one."""
        progressed = False
        for fiber in self.turn_order():
            if not fiber.done and fiber.runnable():
                self._switch(fiber)
                progressed = True
        return progressed

    def _switch(self, fiber: Fiber) -> None:
        fiber.started = True
        self.switches += 1
        if not (fiber.busy or fiber.only_polls()):
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
            fiber.process.fibers_alive -= 1
            self.wake_all()  # it may have been a parallel callback whose group is free now
            if fiber in self.fibers:
                self.fibers.remove(fiber)
            self.fiber_ended(fiber)

    def fiber_ended(self, fiber: Fiber) -> None:
        """Called after a fiber's last turn."""

    def throw(self, stop: type[BaseException], into: list[Fiber]) -> None:
        """Raise this where these fibers wait, at their next turn; those that have not started never do."""
        for fiber in into:
            if fiber.started:
                fiber.thrown = stop()
            else:
                fiber.done = True
        self.fibers = [fiber for fiber in self.fibers if not fiber.done]


_active: Scheduler | None = None


def activate(scheduler: Scheduler | None) -> None:
    """Make this the one scheduler of the process, or none."""
    global _active
    _active = scheduler


# A child process of student code is no part of the run: there, all hooks are inert.
os.register_at_fork(after_in_child=lambda: activate(None))


def active() -> Any:
    """The engine of the run in progress, or None."""
    return _active


@contextlib.contextmanager
def outside_student_code() -> Iterator[None]:
    """Treat what is called in here as code of the course: it sees real clocks, locks and threads."""
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
    """The engine whose student code is calling, or None: every hook checks this first."""
    scheduler = _active
    if scheduler is None or scheduler.current is None or get_ident() != scheduler.thread:
        return None
    return scheduler
