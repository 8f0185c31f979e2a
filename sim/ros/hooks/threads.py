"""Threads and locks of student code: a thread is a fiber, and waiting for a lock takes simulated time."""

from __future__ import annotations

import queue
import sys
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from sim.nanoseconds import nanoseconds
from sim.ros.fibers.fiber import FIBER
from sim.ros.fibers.locks import FiberLock, FiberRLock
from sim.ros.fibers.scheduler import engine
from sim.ros.hooks.table import hook
from sim.ros.recorder.running import callback_name

MOST_THREADS = 1000  # of a program at a time: each machine has such a limit, and a leak should be noticed


@hook(threading.Thread, "start", "a free-running thread would make every run different")
def start(original: Callable) -> Callable:
    def start(self: threading.Thread) -> None:
        run = engine()
        if run is None:
            return original(self)
        if run.current.process.fibers_alive >= MOST_THREADS:
            raise RuntimeError(f"can't start new thread: {MOST_THREADS} of this program are running")
        self._started.set()  # type: ignore[attr-defined]
        # Not the thread's name, which counts all threads of the kernel and would make every run different.
        name = f"thread {callback_name(self._target or type(self))}"  # type: ignore[attr-defined]
        fiber = run.spawn(self.run, name, run.current.process)
        fiber.daemon = self.daemon
        fiber.attach_thread(self)
        return None

    return start


@hook(threading.Thread, "join", "a thread that is a fiber ends in simulated time")
def join(original: Callable) -> Callable:
    def join(self: threading.Thread, timeout: float | None = None) -> None:
        fiber = FIBER.find(self)
        if fiber is None:
            return original(self, timeout)
        run = engine()
        if run is not None and not fiber.done:
            until = None if timeout is None else run.now + nanoseconds(max(timeout, 0))
            run.wait(f"{fiber.name} to end", ready=lambda: fiber.done, until=until)
        return None

    return join


@hook(threading.Thread, "is_alive", "a thread that is a fiber has no thread of the system")
def is_alive(original: Callable) -> Callable:
    def is_alive(self: threading.Thread) -> bool:
        fiber = FIBER.find(self)
        return original(self) if fiber is None else not fiber.done

    return is_alive


@hook(threading, "current_thread", "each fiber that is a thread has the name its student gave it")
def current_thread(original: Callable) -> Callable:
    def current_thread() -> threading.Thread:
        run = engine()
        return (run.current.thread if run is not None else None) or original()

    return current_thread


@hook(threading, "_counter", "names of threads count those of their program, not those of the whole process")
def number_of_thread(original: Callable) -> Callable:
    def number() -> int:
        run = engine()
        return original() if run is None else next(run.current.process.thread_numbers)

    return number


@hook(ThreadPoolExecutor, "_counter", "names of pools count those of their program, too")
def number_of_pool(original: Callable) -> Callable:
    def number(self: ThreadPoolExecutor) -> int:
        run = engine()
        return original() if run is None else next(run.current.process.pool_numbers)

    return number


@hook(threading, "get_ident", "all fibers are one thread; a student's threads differ")
def get_ident(original: Callable) -> Callable:
    def get_ident() -> int:
        run = engine()
        return original() if run is None or run.current.thread is None else id(run.current.thread)

    return get_ident


def _is_student_code(depth: int = 2) -> bool:
    """Return whether student code calls: in a run, or in a cell, whose locks may be used in a run."""
    return engine() is not None or sys._getframe(depth).f_globals.get("__name__") == "__main__"


@hook(threading, "Lock", "a lock held across a wait must not stop the other fibers")
def lock(original: Callable) -> Callable:
    def Lock() -> Any:
        return FiberLock() if _is_student_code() else original()

    return Lock


@hook(threading, "RLock", "a real RLock belongs to a thread, and all fibers are one thread")
def rlock(original: Callable) -> Callable:
    def RLock() -> Any:
        return FiberRLock() if _is_student_code() else original()

    return RLock


@hook(
    threading,
    "_allocate_lock",
    "Condition.wait() sleeps on such a lock; Event, Queue, Semaphore and Barrier use it",
)
def allocate_lock(original: Callable) -> Callable:
    def allocate_lock() -> Any:
        return original() if engine() is None else FiberLock()

    return allocate_lock


@hook(queue, "SimpleQueue", "the one in C waits on a real lock; ThreadPoolExecutor takes its work from one")
def simple_queue(original: Any) -> Callable:
    def SimpleQueue() -> Any:
        return original() if engine() is None else queue._PySimpleQueue()  # type: ignore[attr-defined]

    return SimpleQueue
