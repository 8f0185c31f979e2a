"""What rclpy's executors do with a wait set, done by asking each entity in turn.

Asking is cheaper than waiting (a wait set costs 140 us, a question 1 us) and has one order: that of creation.
Callback groups, coroutines and parallel callbacks keep the meaning that rclpy gives them.
"""

from __future__ import annotations

import contextlib
import inspect
import threading
from collections.abc import Callable, Collection, Iterator
from functools import partial
from typing import TYPE_CHECKING, Any

from rclpy.executors import (
    ConditionReachedException,
    ExternalShutdownException,
    ShutdownException,
    TimeoutException,
    TimeoutObject,
)
from rclpy.task import Task

from sim.nanoseconds import Nanoseconds, nanoseconds
from sim.ros.engine.callbacks import Work, perform, state_of
from sim.ros.engine.processes import shared_context
from sim.ros.engine.ready_scan import ReadyScan
from sim.ros.fibers.exceptions import Livelock
from sim.ros.fibers.fiber import Fiber

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine


def never() -> bool:
    """The condition of a spin that waits for nothing in particular."""
    return False


class OrderedNodes(dict):
    """Stands for an executor's set of nodes; a set's order differs from process to process."""

    def add(self, node: Any) -> None:
        """As `set.add`."""
        self[node] = None

    def remove(self, node: Any) -> None:
        """As `set.remove`."""
        del self[node]


class SimExecutor:
    """How one executor spins in a run."""

    def __init__(self, executor: Any, engine: Engine) -> None:
        self.executor, self.engine = executor, engine
        self.scan = ReadyScan(executor, engine, self._busy)
        self.running: list[Fiber] = []  # parallel callbacks of a multi-threaded executor
        self._workers: list[threading.Thread] = []  # what those say they are; none is ever started
        self._pass: Iterator[Work] | None = None
        self._depth = 0  # callbacks of this executor that are on the stack
        self._lends = False  # work is handed to student code, which runs it when and where it likes

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
        """Run one callback, waiting for it up to `timeout` simulated seconds (None or negative: for ever)."""
        engine = self.engine
        engine.current.process.check_init()
        until = self._end_of(timeout)
        try:
            engine.eager |= parallel
            while not self._over(done, parallel):
                if self.running:
                    self._collect()
                if self._run_one(parallel):
                    return
                if until is not None and engine.now >= until:
                    if timeout == 0:
                        engine.called("empty spins")
                    return
                ready = None if done is never else done
                engine.wait("spin()", ready=ready, until=until, spinning=self)
        finally:
            engine.student_code_ran()

    def handlers(
        self, timeout: float | TimeoutObject | None, nodes: Collection[Any] | None, done: Callable[[], bool]
    ) -> Iterator[tuple[Task, Any, Any]]:
        """What `wait_for_ready_callbacks()` gives to an executor of the student's: (handler, entity, node).

        One pass, for which it waits up to `timeout` simulated seconds. nodes: only these, unless None.
        Raises rclpy's exceptions for a time-out, for a shutdown, and when `done()` is true.
        """
        engine = self.engine
        engine.current.process.check_init()
        until = self._end_of(timeout)
        engine.eager = self._lends = True
        while not self._over(done, parallel=False):
            found = False
            for work in self.scan.ready(nodes):
                found = True
                self._begin(work)
                body = partial(perform, engine, self.executor, work, begun=True)
                yield Task(body, executor=self.executor), work.entity, work.node
                engine.student_code_ran()
            if found:
                return
            if until is not None and engine.now >= until:
                raise TimeoutException()
            engine.wait("spin()", until=until, spinning=self)
        raise ShutdownException() if self.executor._is_shutdown else ConditionReachedException()

    def end_coroutines(self) -> None:
        """End what still waits in an `await`, as freeing it would, but under the guard: it may loop on."""
        engine, process = self.engine, self.engine.processes[0]
        for task, _, _ in self.executor._tasks:
            if inspect.iscoroutine(task._handler):
                engine.spawn(task._handler.close, "the end of a coroutine", process)
        with contextlib.suppress(Livelock):
            engine.settle()

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
                if perform(self.engine, self.executor, work):
                    return True
            finally:
                self._depth -= 1
        return False

    def _start(self, work: Work) -> None:
        """Run a callback in a fiber of its own, at once."""
        engine, spinner = self.engine, self.engine.current
        self._begin(work)
        body = partial(perform, engine, self.executor, work, begun=True)
        fiber = engine.spawn(body, spinner.name, spinner.process, before=spinner)
        fiber.stands_for(self._idle_worker())
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
        """Let nobody else begin it, nor what its callback group keeps out, from now on."""
        if work.entity is None:
            state_of(work.call).seen = self.engine.activity
        elif work.entity.callback_group is not None:
            work.entity.callback_group.beginning_execution(work.entity)

    def _collect(self) -> None:
        """Let an exception of a parallel callback leave spin(), as rclpy does."""
        for fiber in [f for f in self.running if f.done]:
            self.running.remove(fiber)
            if fiber.error is not None:
                raise fiber.error
