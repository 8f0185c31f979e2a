"""Locks for fibers: waiting for a real one would block the thread that all of them share forever."""

from __future__ import annotations

import _thread
from typing import Any

from sim.nanoseconds import nanoseconds
from sim.ros.fibers.fiber import Fiber
from sim.ros.fibers.scheduler import engine


def _deadline(now: int, timeout: float) -> int | None:
    return None if timeout is None or timeout < 0 else now + nanoseconds(timeout)


class FiberLock:
    """`threading.Lock` for student code: waiting for it suspends the fiber and takes simulated time."""

    def __init__(self) -> None:
        self._lock = _thread.allocate_lock()
        self.locked = self._lock.locked
        self.release = self._lock.release

    def acquire(self, blocking: bool = True, timeout: float = -1) -> bool:
        """Work like `threading.Lock.acquire`."""
        if self._lock.acquire(False):
            return True
        run = engine()
        if not blocking or run is None:
            return self._lock.acquire(blocking, timeout)
        until = _deadline(run.now, timeout)
        while until is None or run.now < until:
            run.wait("a lock", ready=lambda: not self._lock.locked(), until=until)
            if self._lock.acquire(False):
                return True
        return False

    def __enter__(self) -> bool:
        return self.acquire()

    def __exit__(self, *exception: object) -> None:
        self._lock.release()

    def __getattr__(self, name: str) -> Any:
        return getattr(self._lock, name)


class FiberRLock:
    """`threading.RLock` for student code. A real one belongs to a thread, and all fibers are one thread."""

    def __init__(self) -> None:
        self._lock = FiberLock()
        self._owner: Fiber | int | None = None
        self._count = 0

    @staticmethod
    def _me() -> Fiber | int:
        run = engine()
        return _thread.get_ident() if run is None else run.current

    def acquire(self, blocking: bool = True, timeout: float = -1) -> bool:
        """Work like `threading.RLock.acquire`."""
        if self._owner == self._me():
            self._count += 1
            return True
        if not self._lock.acquire(blocking, timeout):
            return False
        self._owner, self._count = self._me(), 1
        return True

    def release(self) -> None:
        """Work like `threading.RLock.release`."""
        if self._owner != self._me():
            raise RuntimeError("cannot release un-acquired lock")
        self._count -= 1
        if self._count == 0:
            self._owner = None
            self._lock.release()

    def locked(self) -> bool:
        """Work like `threading.RLock.locked`, which Python has since 3.14, for its Condition."""
        return self._lock.locked()

    def __enter__(self) -> bool:
        return self.acquire()

    def __exit__(self, *exception: object) -> None:
        self.release()

    def _at_fork_reinit(self) -> None:  # in a child process, where nothing holds it
        self._owner, self._count = None, 0
        self._lock._at_fork_reinit()

    # What threading.Condition needs of its lock:

    def _is_owned(self) -> bool:
        return self._owner == self._me()

    def _release_save(self) -> int:
        count, self._count, self._owner = self._count, 0, None
        self._lock.release()
        return count

    def _acquire_restore(self, count: int) -> None:
        self._lock.acquire()
        self._owner, self._count = self._me(), count
