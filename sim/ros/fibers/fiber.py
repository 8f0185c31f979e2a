"""Fibers: each `main()`, thread and parallel callback of a program runs in one, on a greenlet.

A fiber runs until it has to wait; then it stores what for, and returns control to the scheduler.
"""

from __future__ import annotations

import asyncio
import contextvars
import ctypes
import threading
from collections import Counter
from collections.abc import Callable
from typing import Any, Protocol

import greenlet

from sim.nanoseconds import Nanoseconds
from sim.ros.attached import Attached
from sim.ros.fibers.exceptions import RunOver
from sim.ros.fibers.waiter import NEVER, Waiter


class Program(Protocol):
    """The program of a fiber, with its own module-level state of rclpy."""

    name: str
    number: int  # among the programs of the course, or of the student
    key: str  # its name and number, by which an order names it
    target: Callable[..., Any] | str  # what it runs
    main: Any  # the fiber of its main()
    nodes: list[Any]
    from_course: bool  # the course's, not the student's
    bundled: bool  # of a ROS package that the course includes
    host: str  # the computer that it runs on
    reader: Callable[[str, str], Any] | None  # called with "stdout" or "stderr", and text
    fibers_started: int
    fibers_alive: int
    visits: Counter[tuple[str, int]]  # of a function's lines, where a thread may be preempted
    steps: int  # its callbacks, and its fibers' turns except those that only poll an executor

    def load(self) -> None:
        """Make this program's state the module-level state of rclpy."""


class FiberHost(Protocol):
    """The part of a scheduler that a fiber needs."""

    now: Nanoseconds
    hub: greenlet.greenlet


class Fiber:
    """One line of execution of a program."""

    def __init__(self, scheduler: FiberHost, body: Callable[[], Any], name: str, process: Program) -> None:
        self.name, self.process = name, process
        self.number = 0  # among the fibers of its program
        self.done = False
        self.result: Any = None
        self.error: BaseException | None = None
        self.thrown: BaseException | None = None  # raised where the fiber waits, at its next turn
        self.started = False
        self.daemon = False
        self.thread: threading.Thread | None = None  # the student's thread object that this fiber runs
        self.callbacks: list[Any] = []  # those on its stack, outermost first
        self.waits_for = ""
        self.ready: Callable[[], bool] | None = None
        self.wake_at: Nanoseconds | None = None
        self.waiter: Waiter | None = None  # the executor that it spins, while it waits for work
        self.seen_wakes = 0  # how often that one had been woken when the wait began
        self.timer_due: Nanoseconds = NEVER  # when its next timer is due, as of the last change of time
        self.calls: dict[str, int] = {}  # since it last waited, of each kind that a busy loop may make
        self.busy = False  # it loops without a pause, and waits until others of its program have run
        self.running_loop: asyncio.AbstractEventLoop | None = None  # asyncio's, while it waits inside one
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

    def attach_thread(self, thread: threading.Thread) -> None:
        """Make this the thread that student code finds as its own, alive while the fiber is."""
        self.thread = thread
        FIBER.attach(thread, self)

    def runnable(self) -> bool:
        """Return whether what it waits for has happened."""
        if not self.started or self.thrown is not None:
            return True
        waiter, now = self.waiter, self._scheduler.now
        if waiter is not None and (waiter.wakes != self.seen_wakes or now >= self.timer_due):
            return True
        if self.wake_at is not None and now >= self.wake_at:
            return True
        return self.ready is not None and bool(self.ready())

    def next_due(self) -> Nanoseconds:
        """Return when it goes on at the latest; NEVER if only something else can let it."""
        return min(NEVER if self.wake_at is None else self.wake_at, self.timer_due if self.waiter else NEVER)

    def only_polls(self) -> bool:
        """Return whether it spins an executor, and its turn is only a look for work there."""
        in_time = self.wake_at is None or self._scheduler.now < self.wake_at
        return self.waiter is not None and in_time

    def park(self) -> None:
        """Leave this fiber where it is, forever.

        For code that swallows every exception thrown into it. Freeing its greenlet would throw once more, so
        it is made immortal: a small leak instead of a lost kernel. Call only from this fiber's own stack.
        """
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(self.greenlet))
        self.done = True
        self._scheduler.hub.switch()


FIBER = Attached[Fiber]()  # of a Thread
