"""In a notebook, a spin outside a run is stopped after two seconds, and rclpy is shut down again."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterator
from typing import Any

import rclpy
from rclpy.executors import Executor
from rclpy.node import Node

from sim.notebook import spin_outside_run
from sim.ros.fibers.scheduler import engine
from sim.ros.hooks.table import hook


@hook(rclpy, "spin", "in a notebook it waits without end on the wall clock, where no robot is")
def spin(original: Callable) -> Callable:
    def spin(node: Node, executor: Executor | None = None) -> None:
        if engine() is not None or not spin_outside_run.is_limited():
            return original(node, executor)
        executor = rclpy.get_global_executor() if executor is None else executor
        executor.add_node(node)
        with _cleaned_up():
            _spin_for_a_while(executor, "rclpy.spin()", node)
        return executor.remove_node(node)

    return spin


@hook(Executor, "spin", "in a notebook it waits without end on the wall clock, where no robot is")
def executor_spin(original: Callable) -> Callable:
    def spin(self: Executor) -> None:
        if engine() is not None or not spin_outside_run.is_limited():
            return original(self)
        with _cleaned_up():
            return _spin_for_a_while(self, "executor.spin()", None)

    return spin


@hook(Executor, "spin_until_future_complete", "in a notebook it may wait without end on the wall clock")
def executor_spin_until(original: Callable) -> Callable:
    def spin_until_future_complete(self: Executor, future: Any, timeout_sec: float | None = None) -> None:
        endless = timeout_sec is None or timeout_sec < 0
        if not endless or engine() is not None or not spin_outside_run.is_limited():
            return original(self, future, timeout_sec)
        with _cleaned_up():
            original(self, future, spin_outside_run.LIMIT)
            if not future.done() and self.context.ok():
                raise spin_outside_run.spin_error("spin_until_future_complete()")

    return spin_until_future_complete


def _spin_for_a_while(executor: Executor, what: str, node: Node | None) -> None:
    clock = time.monotonic
    end = clock() + spin_outside_run.LIMIT
    while executor.context.ok() and not executor._is_shutdown:
        if clock() >= end:
            raise spin_outside_run.spin_error(what, node)
        executor.spin_once(timeout_sec=max(end - clock(), 0.0))


@contextlib.contextmanager
def _cleaned_up() -> Iterator[None]:
    """After an error or an interrupt in this block, shut rclpy down when the cell has ended.

    Not at once: the program may do so itself, in its `finally`.
    """
    try:
        yield
    except BaseException:
        spin_outside_run.after_cell(_shut_down)
        raise


def _shut_down() -> None:
    executor = rclpy.get_global_executor() if rclpy.ok() else None
    for node in executor.get_nodes() if executor is not None else ():
        executor.remove_node(node)
        node.destroy_node()
    rclpy.try_shutdown()
