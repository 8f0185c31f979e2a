"""How an executor of rclpy spins in a run: it checks each entity in turn instead of waiting on a wait set.

Checking is cheaper (a wait set costs 140 us, a check 1 us) and has one order: that of creation.
Callback groups, coroutines and parallel callbacks keep the meaning that rclpy gives them.
"""

from __future__ import annotations

import contextlib
import inspect
import threading
from collections.abc import Callable, Collection, Iterator
from functools import partial
from typing import Any
from weakref import WeakSet

from rclpy.exceptions import InvalidHandle
from rclpy.executors import (
    ConditionReachedException,
    ExternalShutdownException,
    ShutdownException,
    TimeoutException,
    TimeoutObject,
)
from rclpy.task import Future, Task

from sim.evidence import TAKEN_OVER
from sim.nanoseconds import Nanoseconds, nanoseconds
from sim.ros.attached import Attached
from sim.ros.engine.callbacks import Work, state_of
from sim.ros.engine.engine import Engine
from sim.ros.engine.ready_scan import ReadyScan
from sim.ros.engine.running_program import shared_context
from sim.ros.fibers.fiber import Fiber
from sim.ros.fibers.waiter import NEVER, Waiter
from sim.ros.rclpy_cpp import cpp

RCLError = cpp.RCLError
NOT_VALID = "the given context is not valid, either rcl_init() was not called or rcl_shutdown() was called."


def never() -> bool:
    """The condition of a spin that waits for nothing in particular."""
    return False


class OrderedNodes(dict):
    """Replaces an executor's set of nodes, whose order differs from process to process."""

    def add(self, node: Any) -> None:
        """Work like `set.add`."""
        self[node] = None

    def remove(self, node: Any) -> None:
        """Work like `set.remove`."""
        del self[node]


class SimExecutor(Waiter):
    """One executor in a run."""

    def __init__(self, executor: Any, engine: Engine) -> None:
        super().__init__()
        self.executor, self.engine = executor, engine
        self.scan = ReadyScan(executor, engine, self, self._busy)
        engine.waiters.add(self)
        self.running: list[Fiber] = []  # parallel callbacks of a multi-threaded executor
        self._workers: list[threading.Thread] = []  # their thread objects; none is ever started
        self._pass: Iterator[Work] | None = None
        self._last_spin: tuple[Any, Any] = (None, never)  # timeout and condition of the last spin_once
        self._depth = 0  # callbacks of this executor that are on the stack
        self.spinning = 0  # calls of `spin_once` under way
        self.wakers: WeakSet[Future] = WeakSet()  # futures whose completion wakes this executor
        self.lost: list[Any] = []  # nodes that another executor took over while this one did not spin
        self._lends = False  # work is given to student code, which runs it when and where it likes

    def _busy(self) -> bool:
        return bool(self._depth or self.running or self._lends or self.executor._tasks)

    def _next(self) -> Iterator[Work]:
        """Ready work: the rest of the pass under way first, then one whole new pass."""
        if self._depth:  # a callback spins: the pass under way isn't its own
            yield from self.scan.ready()
            return
        for _ in range(1 if self._pass is None else 2):
            if self._pass is None:
                self._pass = self.scan.ready()
            # Not `yield from`: that would close the pass together with this generator.
            for work in self._pass:  # noqa: UP028
                yield work
            self._pass = None

    def spin_once(
        self, timeout: float | TimeoutObject | None, done: Callable[[], bool], parallel: bool
    ) -> None:
        """Run one callback, waiting for it up to `timeout` simulated seconds (None or negative: forever)."""
        engine = self.engine
        engine.current.process.check_init()
        until = self._end_of(timeout)
        if until is not None and until > engine.now and not shared_context(self.executor.context).alive:
            raise RCLError(f"failed to create timer: {NOT_VALID}")  # rclpy's, for the timeout
        self.spinning += 1
        if self._last_spin != (timeout, done):  # as in rclpy, the pass under way goes on for equal ones only
            self._pass, self._last_spin = None, (timeout, done)
        self._report_lost_nodes()
        try:
            while not self._over(done, parallel):
                if self.running:
                    self._collect()
                if self._run_one(parallel):
                    return
                if until is not None and engine.now >= until:
                    if timeout == 0:
                        engine.count_call("empty spins")
                    return
                ready = None if done is never else done
                engine.wait("spin()", ready=ready, until=until, spinning=self)
        finally:
            self.spinning -= 1
            engine.student_code_ran()

    def added_elsewhere(self, node: Any) -> None:
        """Another executor takes over a node of this one: recorded as soon as this one spins."""
        self.lost.append(node)
        if self.spinning:
            self._report_lost_nodes()

    def _report_lost_nodes(self) -> None:
        while self.lost:
            node = self.lost.pop()
            if node.executor is not self.executor:
                self.engine.recorder.node_fact(node, TAKEN_OVER)

    def handlers(
        self, timeout: float | TimeoutObject | None, nodes: Collection[Any] | None, done: Callable[[], bool]
    ) -> Iterator[tuple[Task, Any, Any]]:
        """Yield what `wait_for_ready_callbacks()` gives a student's own executor: (handler, entity, node).

        One pass, for which it waits up to `timeout` simulated seconds. nodes: only these, unless None.
        Raises rclpy's exceptions for a time-out, for a shutdown, and when `done()` is true.
        """
        engine = self.engine
        engine.current.process.check_init()
        until = self._end_of(timeout)
        self._lends = True
        while not self._over(done, parallel=False):
            found = False
            for work in self.scan.ready(nodes):
                found = True
                self._begin(work)
                body = partial(engine.callbacks.perform, self.executor, self, work, begun=True)
                yield Task(body, executor=self.executor), work.entity, work.node
                engine.student_code_ran()
            if found:
                return
            if until is not None and engine.now >= until:
                raise TimeoutException()
            engine.wait("spin()", until=until, spinning=self)
        raise ShutdownException() if self.executor._is_shutdown else ConditionReachedException()

    def next_due(self) -> Nanoseconds:
        """Work like Waiter: from now on, the time at which a timer that isn't due yet will be."""
        first = None
        for timer in self.scan.timers:
            try:
                handle = timer.handle
                left = None if handle.is_timer_canceled() else handle.time_until_next_call()
            except (InvalidHandle, RCLError):  # destroyed, and still listed
                continue
            if left is not None and left > 0 and (first is None or left < first):
                first = left
        return NEVER if first is None else self.engine.now + first

    def end_coroutines(self) -> None:
        """Work like Waiter, as freeing them would, but under the guard: they may loop on."""
        engine, program = self.engine, self.engine.programs[0]
        for task, _, _ in self.executor._tasks:
            if inspect.iscoroutine(task._handler):
                engine.spawn(task._handler.close, "the end of a coroutine", program)
        engine.finish()

    def close(self) -> None:
        """Work like Waiter."""
        with contextlib.suppress(InvalidHandle):
            self.executor.shutdown()

    def _end_of(self, timeout: float | TimeoutObject | None) -> Nanoseconds | None:
        if isinstance(timeout, TimeoutObject):
            timeout = timeout.timeout
        return None if timeout is None or timeout < 0 else self.engine.now + nanoseconds(timeout)

    def _over(self, done: Callable[[], bool], parallel: bool) -> bool:
        if self.executor._is_shutdown or (done is not never and done()):
            return True
        if shared_context(self.executor.context).alive:
            return False
        if parallel:  # rclpy's MultiThreadedExecutor ends quietly
            return True
        raise ExternalShutdownException()

    def _run_one(self, parallel: bool) -> bool:
        if parallel and len(self.running) >= self.executor._executor._max_workers:
            return False
        for work in self._next():
            if parallel:
                self._start(work)
                return True
            self._depth += 1
            try:
                if self.engine.callbacks.perform(self.executor, self, work):
                    return True
            finally:
                self._depth -= 1
        return False

    def _start(self, work: Work) -> None:
        """Run a callback in a fiber of its own, at once."""
        engine, spinner = self.engine, self.engine.current
        self._begin(work)
        body = partial(engine.callbacks.perform, self.executor, self, work, begun=True)
        fiber = engine.spawn(body, spinner.name, spinner.process, before=spinner)
        fiber.attach_thread(self._idle_worker())
        self.running.append(fiber)

    def _idle_worker(self) -> threading.Thread:
        """The first thread of the executor's pool that no callback has."""
        busy = [fiber.thread for fiber in self.running]
        idle = [worker for worker in self._workers if worker not in busy]
        if not idle:
            name = f"{self.executor._executor._thread_name_prefix}_{len(self._workers)}"
            idle = [threading.Thread(name=name)]
            self._workers += idle
        return idle[0]

    def _begin(self, work: Work) -> None:
        """Mark work as begun: neither it nor what its callback group excludes is ready from now on."""
        if work.entity is None:
            state_of(work.call).seen_wakes = self.wakes
        elif work.entity.callback_group is not None:
            work.entity.callback_group.beginning_execution(work.entity)

    def _collect(self) -> None:
        """Let an exception of a parallel callback leave spin(), as rclpy does."""
        for fiber in [f for f in self.running if f.done]:
            self.running.remove(fiber)
            if fiber.error is not None:
                raise fiber.error


EXECUTOR = Attached[SimExecutor]()  # of an Executor
