"""rclpy's executors check their entities in a fixed order, and wait in simulated time."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from types import ModuleType
from typing import Any
from weakref import WeakSet

import rclpy.experimental.events_executor
import rclpy.wait_for_message
from rclpy.executors import Executor, MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.guard_condition import GuardCondition
from rclpy.node import Node
from rclpy.task import Future

from sim.evidence import SPUN
from sim.nanoseconds import nanoseconds
from sim.ros.engine.sim_executor import EXECUTOR, OrderedNodes, SimExecutor, never
from sim.ros.fibers.scheduler import engine
from sim.ros.hooks.table import hook
from sim.ros.transport.reader import READER

# Executors of TransformListener(..., spin_thread=True): whichever of two has the node, its callbacks run.
_OF_LISTENERS: WeakSet[Executor] = WeakSet()
PARALLEL_CALLBACKS = 4  # of a MultiThreadedExecutor() without a number: rclpy's default varies


@hook(Executor, "__init__", "an executor's nodes are a set, whose order differs from process to process")
def executor_init(original: Callable) -> Callable:
    def __init__(self: Executor, **keywords: Any) -> None:
        original(self, **keywords)
        run = engine()
        if run is not None:
            self._nodes = OrderedNodes()
            EXECUTOR.attach(self, SimExecutor(self, run))

    return __init__


@hook(MultiThreadedExecutor, "__init__", "the default number of threads is the machine's number of cores")
def multi_threaded_init(original: Callable) -> Callable:
    def __init__(self: MultiThreadedExecutor, num_threads: int | None = None, **keywords: Any) -> None:
        if num_threads is None and engine() is not None:
            num_threads = PARALLEL_CALLBACKS
        original(self, num_threads, **keywords)

    return __init__


def _spin_once_impl(owner: type, parallel: bool) -> None:
    @hook(owner, "_spin_once_impl", "waiting for callbacks takes simulated time, and they come in one order")
    def spin(original: Callable) -> Callable:
        def _spin_once_impl(self: Any, timeout_sec: Any = None, wait_condition: Callable = never) -> None:
            sim = EXECUTOR.find(self)
            if sim is None or engine() is not sim.engine:
                return original(self, timeout_sec, wait_condition)
            return sim.spin_once(timeout_sec, wait_condition, parallel)

        return _spin_once_impl


_spin_once_impl(SingleThreadedExecutor, parallel=False)
_spin_once_impl(MultiThreadedExecutor, parallel=True)


def _spin_once_until_future_complete(owner: type) -> None:
    @hook(owner, "spin_once_until_future_complete", "each spin would leave one more task that only wakes it")
    def spin(original: Callable) -> Callable:
        def spin_once_until_future_complete(self: Any, future: Future, timeout_sec: Any = None) -> None:
            sim = EXECUTOR.find(self)
            if sim is None or engine() is not sim.engine or future not in sim.wakers:
                if sim is not None:
                    sim.wakers.add(future)
                return original(self, future, timeout_sec)
            return self._spin_once_impl(timeout_sec, future.done)

        return spin_once_until_future_complete


_spin_once_until_future_complete(SingleThreadedExecutor)
_spin_once_until_future_complete(MultiThreadedExecutor)


@hook(Executor, "_wait_for_ready_callbacks", "a student's own executor waits in simulated time, too")
def wait_for_ready_callbacks(original: Callable) -> Callable:
    def _wait_for_ready_callbacks(
        self: Executor, timeout_sec: Any = None, nodes: Any = None, condition: Callable = never
    ) -> Iterator[tuple[Any, Any, Any]]:
        sim = EXECUTOR.find(self)
        if sim is None or engine() is not sim.engine:
            return original(self, timeout_sec, nodes, condition)
        return sim.handlers(timeout_sec, nodes, condition)

    return _wait_for_ready_callbacks


def _changes_entities(name: str) -> None:
    @hook(Executor, name, "executors list their entities anew when some are created or destroyed")
    def method(original: Callable) -> Callable:
        def replacement(self: Executor, *arguments: Any, **keywords: Any) -> Any:
            run = engine()
            if run is not None:
                run.waiters.endpoints_changed()
            return original(self, *arguments, **keywords)

        return replacement


for _name in ("wake", "remove_node"):
    _changes_entities(_name)


@hook(Executor, "add_node", "executors list their entities anew; a node that leaves another one is recorded")
def add_node(original: Callable) -> Callable:
    def add_node(self: Executor, node: Node) -> bool:
        run = engine()
        if run is None:
            return original(self, node)
        run.waiters.endpoints_changed()
        before = node.executor
        if sys._getframe(1).f_globals.get("__name__", "").startswith("tf2_ros."):
            _OF_LISTENERS.add(self)
        spun_before = isinstance(before, Executor) and before is not self and node in before._nodes
        added = original(self, node)
        if spun_before and not (self in _OF_LISTENERS or before in _OF_LISTENERS):
            EXECUTOR.of(before).added_elsewhere(node)
        return added

    return add_node


@hook(GuardCondition, "trigger", "there is no wait set to notice that a guard condition was triggered")
def trigger(original: Callable) -> Callable:
    def trigger(self: GuardCondition) -> None:
        run = engine()
        if run is not None:
            self._executor_triggered = True
            run.wake_all()
        original(self)

    return trigger


def _no_events_executor(module: ModuleType) -> None:
    @hook(module, "EventsExecutor", "it waits in C++ and runs simultaneous callbacks in a random order")
    def events_executor(original: Callable) -> Callable:
        def EventsExecutor(**keywords: Any) -> Executor:
            if engine() is not None:
                raise NotImplementedError(
                    "EventsExecutor can't run in simulated time. "
                    "Use SingleThreadedExecutor or MultiThreadedExecutor."
                )
            return original(**keywords)

        return EventsExecutor


_no_events_executor(rclpy.experimental)
_no_events_executor(rclpy.experimental.events_executor)


@hook(rclpy.wait_for_message, "wait_for_message", "it waits on a wait set of its own, in wall time")
def wait_for_message(original: Callable) -> Callable:
    def wait_for_message(
        msg_type: Any, node: Node, topic: str, *, qos_profile: Any = 1, time_to_wait: float = -1
    ) -> tuple[bool, Any]:
        run = engine()
        if run is None:
            return original(msg_type, node, topic, qos_profile=qos_profile, time_to_wait=time_to_wait)
        subscription = node.create_subscription(msg_type, topic, lambda _: None, qos_profile)
        run.recorder.node_fact(node, SPUN)
        taken: list[Any] = []

        def arrived() -> bool:
            sent = None if taken else READER.of(subscription).take()
            if sent is not None:
                taken.append(sent.message)
            return bool(taken) or not node.context.ok()

        until = None if time_to_wait < 0 else run.now + nanoseconds(time_to_wait)
        try:
            if not arrived():
                run.wait(f"a message on {topic}", ready=arrived, until=until)
        finally:
            node.destroy_subscription(subscription)
        return (True, taken[0]) if taken else (False, None)

    return wait_for_message
