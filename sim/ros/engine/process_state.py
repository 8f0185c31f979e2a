"""Process-wide state that a run borrows while it executes and restores when it pauses.

Each class here stores the user's state while the run executes, and the run's own while it pauses.
"""

from __future__ import annotations

import asyncio
import contextlib
import gc
import random
import sys
from collections.abc import Iterator
from typing import Any
from weakref import WeakKeyDictionary

import greenlet
import numpy as np
import rclpy
import rclpy.context
import rclpy.utilities
from rclpy.context import Context

from sim.ros.rclpy_cpp import cpp


class SeededRandom:
    """`random` and numpy's old generator, seeded by the run."""

    def __init__(self, seed: int) -> None:
        self._runs = random.Random(seed).getstate(), np.random.RandomState(seed % 2**32).get_state()

    @contextlib.contextmanager
    def borrowed(self) -> Iterator[None]:
        """Use the run's state of them in this block."""
        users = random.getstate(), np.random.get_state()
        self._set(self._runs)
        try:
            yield
        finally:
            self._runs = random.getstate(), np.random.get_state()
            self._set(users)

    def _set(self, states: tuple) -> None:
        random.setstate(states[0])
        np.random.set_state(states[1])


class SeededBytes:
    """The bytes of `os.urandom` in a run; the programs' use of `random` doesn't shift them."""

    def __init__(self, seed: int) -> None:
        self._random = random.Random(f"chance of run {seed}")

    def bytes(self, size: int) -> bytes:
        """The next `size` of them."""
        return self._random.randbytes(size)


class FiberEventLoops(asyncio.DefaultEventLoopPolicy):
    """Stores for each fiber what asyncio stores for each thread: the event loop that was set."""

    def __init__(self) -> None:
        self._locals: WeakKeyDictionary[greenlet.greenlet, Any] = WeakKeyDictionary()
        super().__init__()

    @property
    def _local(self) -> Any:
        return self._locals.setdefault(greenlet.getcurrent(), self._Local())  # type: ignore[attr-defined]

    @_local.setter
    def _local(self, shared: Any) -> None:
        """Ignored: all fibers are one thread, and would share it."""


class ProcessState:
    """Hides from the nodes what a process of their own would not have.

    A notebook's kernel runs an event loop, with which asyncio.run() fails, and has command-line arguments and
    a stdin of its own. And its heap is large: one full garbage collection takes 0.2 s. So from the first step
    of a run to its end the collector sees only what was created meanwhile, and runs less often: most of that
    is recorded, and stays.
    """

    NEW_OBJECTS = 3_000  # until the collector runs
    unfinished = 0  # runs that have begun and not ended: while a player waits, other runs may begin and end

    def __init__(self) -> None:
        self._policy = FiberEventLoops()
        self._begun = False

    @contextlib.contextmanager
    def borrowed(self) -> Iterator[None]:
        """Hide it in this block."""
        self._begin()
        loop, policy = asyncio._get_running_loop(), asyncio.get_event_loop_policy()
        argv, stdin = sys.argv, sys.stdin
        asyncio._set_running_loop(None)
        asyncio.set_event_loop_policy(self._policy)
        usual = gc.get_threshold()
        gc.set_threshold(usual[0] and max(self.NEW_OBJECTS, usual[0]), *usual[1:])
        try:
            yield
        finally:
            gc.set_threshold(*usual)
            asyncio.set_event_loop_policy(policy)
            asyncio._set_running_loop(loop)
            sys.argv, sys.stdin = argv, stdin

    def _begin(self) -> None:
        if not self._begun:
            self._begun = True
            if not ProcessState.unfinished:
                gc.freeze()
            ProcessState.unfinished += 1

    def collect(self) -> None:
        """Free what the run has left: it has ended."""
        gc.collect()
        self._begun = False
        ProcessState.unfinished -= 1
        if not ProcessState.unfinished:
            gc.unfreeze()


class RclpyState:
    """rclpy's contexts, global executor and levels of loggers. context: the one real context of the run."""

    def __init__(self) -> None:
        self.context = Context()
        # The other side's levels: the user's while rclpy is lent, the run's while it isn't.
        self.log_levels: dict[str, int] = {}
        self._users_default = self._default = cpp.rclpy_logging_get_logger_level("")
        self._runs_contexts = self._users_contexts = 0  # as far as rclpy counts them, for its logging

    @contextlib.contextmanager
    def borrowed(self) -> Iterator[None]:
        """Use the run's state of rclpy in this block; each program of the run then has its own."""
        users = rclpy.utilities.g_default_context, rclpy.__dict__["__executor"]
        self._users_contexts = rclpy.context.g_logging_ref_count - self._runs_contexts
        self._swap_log_levels()
        try:
            yield
        finally:
            self._swap_log_levels()
            self._runs_contexts = rclpy.context.g_logging_ref_count - self._users_contexts
            rclpy.utilities.g_default_context, rclpy.__dict__["__executor"] = users

    def level_is_set(self, logger: str) -> None:
        """Store the user's level of a logger that gets another one now."""
        self.log_levels.setdefault(logger, cpp.rclpy_logging_get_logger_level(logger))

    def set_default_level(self, level: int | None) -> None:
        """Set the level of loggers without one of their own; None: the user's."""
        level = self._users_default if level is None else level
        if level != self._default:
            self.level_is_set("")
            cpp.rclpy_logging_set_logger_level("", level)
            self._default = level

    def forget_contexts(self, but: int) -> None:
        """Make rclpy count only so many of the run's contexts, whatever its programs left open."""
        rclpy.context.g_logging_ref_count = self._users_contexts + but

    def _swap_log_levels(self) -> None:
        for logger, level in self.log_levels.items():
            self.log_levels[logger] = cpp.rclpy_logging_get_logger_level(logger)
            cpp.rclpy_logging_set_logger_level(logger, level)
