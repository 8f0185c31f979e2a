"""Waiting for other processes: it takes wall time, and no simulated time, up to a limit."""

from __future__ import annotations

import multiprocessing.connection
import os
import subprocess
from collections.abc import Callable, Iterable
from typing import Any

from sim.ros.fibers.scheduler import engine, outside_student_code
from sim.ros.hooks.table import hook

REASON = "another process runs in wall time, which takes no simulated time"


def _limited(run: Any, timeout: float | None) -> tuple[float | None, bool]:
    """Return how long a student's code may wait (s, wall time), and whether that is less than it wants."""
    limit = run.guard.waiting_limit
    less = timeout is None or timeout > limit
    return (limit if less else timeout), less


@hook(subprocess.Popen, "_wait", REASON)
def wait_for_child(original: Callable) -> Callable:
    def _wait(self: subprocess.Popen, timeout: float | None) -> int:
        run = engine()
        if run is None:
            return original(self, timeout)
        allowed, less = _limited(run, timeout)
        try:
            with outside_student_code():  # it sleeps between two polls, and its time-out is in wall time
                return original(self, allowed)
        except subprocess.TimeoutExpired:
            if not less:
                raise
        return run.guard.waited("another process")

    return _wait


@hook(os, "system", REASON)
def system(original: Callable) -> Callable:
    def system(command: str) -> int:
        if engine() is None:
            return original(command)
        status = subprocess.call(command, shell=True)  # C's function can't be interrupted
        return -status if status < 0 else status << 8

    return system


@hook(multiprocessing.connection, "wait", REASON)
def wait_for_connections(original: Callable) -> Callable:
    def wait(object_list: Iterable[Any], timeout: float | None = None) -> list[Any]:
        run = engine()
        if run is None:
            return original(object_list, timeout)
        allowed, less = _limited(run, timeout)
        with outside_student_code():
            ready = original(object_list, allowed)
        if less and not ready:
            run.guard.waited("another process")
        return ready

    return wait
