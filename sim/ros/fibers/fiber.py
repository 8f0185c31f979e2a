"""Fibers: each student `main()`, thread and parallel callback is one, on a greenlet.

A fiber runs until it would wait; then it says what it waits for and hands control back.
"""

from __future__ import annotations

import asyncio
import contextvars
import ctypes
import threading
from collections.abc import Callable
from typing import Any, Protocol

import greenlet

from sim.nanoseconds import Nanoseconds
from sim.ros.fibers.exceptions import RunOver


class Program(Protocol):
    """What a fiber belongs to: one program, with a state of rclpy that is its own."""

    name: str
    nodes: list[Any]
    from_course: bool  # it is not the student's
    host: str  # the computer that it runs on
    steps: int  # callbacks of it, and turns of its fibers, but for those that only spin

    def load(self) -> None:
        """Let rclpy's module-level state be this program's."""


class Turns(Protocol):
    """What a fiber asks of its scheduler."""

    now: Nanoseconds
    activity: int
    hub: greenlet.greenlet


class Fiber:
    """One line of execution of a student process."""

    def __init__(self, scheduler: Turns, body: Callable[[], Any], name: str, process: Program) -> None:
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
        self.calls: dict[str, int] = {}  # since it last waited, of each kind that a busy loop may make
        self.busy = False  # it loops without a pause, and waits until others of its program have gone on
        self.running_loop: asyncio.AbstractEventLoop | None = None  # asyncio's, while it waits inside of one
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

    def stands_for(self, thread: threading.Thread) -> None:
        """Let student code find this thread as its own, alive while the fiber is."""
        self.thread, thread._sim = thread, self

    def runnable(self) -> bool:
        """Whether what it waits for has come."""
        if not self.started or self.thrown is not None:
            return True
        if self.wake_at is not None and self._scheduler.now >= self.wake_at:
            return True
        if self.seen_activity is not None and self.seen_activity != self._scheduler.activity:
            return True
        return self.ready is not None and bool(self.ready())

    def is_asked(self) -> bool:
        """Whether it spins and goes on only to ask whether there is work for it."""
        in_time = self.wake_at is None or self._scheduler.now < self.wake_at
        return self.spins is not None and in_time

    def park(self) -> None:
        """Leave this fiber where it is, for ever.

        For code that swallows every exception thrown into it. Freeing its greenlet would throw once more, so
        it is made immortal: a small leak instead of a lost kernel. Call only from this fiber's own stack.
        """
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(self.greenlet))
        self.done = True
        self._scheduler.hub.switch()
