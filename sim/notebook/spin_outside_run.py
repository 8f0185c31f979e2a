"""What a notebook does about a spin outside a run: it would wait on the wall clock without end."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from types import FrameType
from typing import Any

from sim.notebook.kernel import shell

LIMIT = 2.0  # s of wall time


class SpinOutsideRunError(RuntimeError):
    """A spin in a cell did not return. A notebook shows this error in one paragraph."""

    def _render_traceback_(self) -> list[str]:
        return [f"SpinOutsideRunError: {self}"]


def is_limited() -> bool:
    """Return whether a spin here blocks a notebook's cell: the caller is the main thread of a kernel."""
    return shell() is not None and threading.current_thread() is threading.main_thread()


def spin_error(what: str, node: Any = None) -> SpinOutsideRunError:
    """The error for a spin that is stopped. what: such as "rclpy.spin()"; node: its argument, if any."""
    target, call = _program(node)
    replaced = (
        f"Write run({target}, seconds=10) in place of {call}" if call else f"Write run({target}, seconds=10)"
    )
    return SpinOutsideRunError(
        f"{what} was stopped after {LIMIT:g} s: in a notebook it waits on the wall clock and never returns, "
        f"and no robot can reach it. {replaced}, with `from sim import run`: it runs the same code in "
        'simulated time, with a robot if you add world="room". On a real robot the code stays as it is. '
        "rclpy has been shut down."
    )


def after_cell(clean: Callable[[], None]) -> None:
    """Call `clean` once, when the running cell has ended."""
    events = shell().events

    def once(*_: Any) -> None:
        events.unregister("post_run_cell", once)
        clean()

    events.register("post_run_cell", once)


def _program(node: Any) -> tuple[str, str]:
    """The outermost function of the notebook, to be run instead, and its call in the cell."""
    functions: list[FrameType] = []
    frame: FrameType | None = sys._getframe(1)
    while frame is not None:
        if _is_of_notebook(frame):
            functions.append(frame)
        frame = frame.f_back
    if functions:
        name = functions[-1].f_code.co_name
        return name, f"{name}()"
    name = type(node).__name__
    return ("main", "") if node is None or name == "Node" else (name, "these lines")


def _is_of_notebook(frame: FrameType) -> bool:
    """Return whether it is a function that a cell has defined at its top level, not the cell itself."""
    name = frame.f_code.co_name
    return frame.f_globals is shell().user_ns and name.isidentifier() and name in frame.f_globals
