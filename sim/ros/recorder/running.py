"""A callback under way, and the name that a student knows it by."""

from __future__ import annotations

from functools import partial
from typing import Any, NamedTuple

from rclpy.task import Task

from sim.nanoseconds import Nanoseconds


class RunningCallback(NamedTuple):
    """A callback under way."""

    name: str
    node: str
    kind: str
    began: Nanoseconds
    group: Any


def callback_name(function: Any) -> str:
    """The name a student knows a callback by, e.g. "Talker.tick"."""
    while isinstance(function, partial):
        function = function.func
    if isinstance(function, Task):
        coroutine = function._handler
        frame = getattr(coroutine, "cr_frame", None)
        execute = frame.f_locals.get("execute_callback") if frame is not None else None
        return callback_name(execute or coroutine)
    name = getattr(function, "__qualname__", None) or type(function).__name__
    owner = getattr(function, "__self__", None)
    if owner is not None and "<locals>" not in name:
        name = f"{type(owner).__name__}.{getattr(function, '__name__', name)}"
    return name.rsplit("<locals>.", 1)[-1]
