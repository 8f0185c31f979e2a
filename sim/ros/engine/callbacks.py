"""Runs callbacks: their groups, their names, how long they took, and what they raised."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, NamedTuple

from rclpy.task import Task

from sim.evidence import UNFINISHED, UNMATCHED
from sim.nanoseconds import Nanoseconds
from sim.ros.attached import Attached
from sim.ros.engine.limits import RunLimits
from sim.ros.engine.unmatched_stamps import unmatched_topics
from sim.ros.fibers.scheduler import Scheduler
from sim.ros.fibers.waiter import Waiter
from sim.ros.recorder.recorder import Recorder
from sim.ros.recorder.running import RunningCallback, callback_name


class Work(NamedTuple):
    """One callback that is ready. entity is None for a task."""

    kind: str
    entity: Any
    node: Any
    call: Callable[..., Any]
    arguments: tuple = ()
    names: Callable[..., Any] | None = None  # the function to name to the reader, if it isn't `call`


@dataclass(slots=True)
class TaskState:
    """A run's data on a task: the callback that it is, if any; and how it goes on."""

    running: RunningCallback | None = None
    seen_wakes: int | None = None  # of its executor, when it last waited
    since: Nanoseconds = 0  # when it last made progress


TASK_STATE = Attached[TaskState]()


def state_of(task: Task) -> TaskState:
    """Return what the run stores with a task."""
    return TASK_STATE.find(task) or TASK_STATE.attach(task, TaskState())


def is_coroutine_function(function: Any) -> bool:
    """Work like `inspect.iscoroutinefunction`, which is slow, for the functions that callbacks mostly are."""
    code = getattr(function, "__code__", None)
    return (
        bool(code.co_flags & inspect.CO_COROUTINE)
        if code is not None
        else inspect.iscoroutinefunction(function)
    )


class Callbacks:
    """The callbacks of one run: each is counted, and recorded with its duration and what it raised."""

    def __init__(self, scheduler: Scheduler, recorder: Recorder, limits: RunLimits) -> None:
        self._scheduler, self._recorder, self._limits = scheduler, recorder, limits
        self._names: dict[int, tuple[Callable, str]] = {}  # by the id of the entity they belong to
        self.suspended: list[RunningCallback] = []  # coroutines that wait for something

    def perform(self, executor: Any, waiter: Waiter, work: Work, begun: bool = False) -> bool:
        """Run a callback to its end or its first await; False if it could not begin or go on.

        executor, waiter: rclpy's executor, and what represents it in the run. begun: its callback group knows
        of it already.
        """
        self._limits.count_callback()
        if work.entity is None:
            return self._resume(waiter, work)
        group = work.entity.callback_group
        if group is not None and not begun and not group.beginning_execution(work.entity):
            return False
        self._scheduler.student_code_ran()
        if is_coroutine_function(work.call):
            running = self._running(work)
            task = Task(self._recorded_coroutine, (work, running), executor=executor)
            state_of(task).running = running
            state_of(task).since = running.began
            executor._tasks.append((task, work.entity, work.node))
            self._step(task)
            return True
        try:
            self._call(self._running(work), work.call, work.arguments)
        finally:
            if group is not None:
                group.ending_execution(work.entity)
        return True

    def note_unfinished(self, nodes: Iterable[Any]) -> None:
        """The run ends: record of which nodes a callback is under way, and which synchronizers had no set."""
        for node in nodes:
            for topics in unmatched_topics(node):
                self._recorder.node_fact(node, " ".join([UNMATCHED, *topics]))
        on_stacks = (running for fiber in self._scheduler.fibers for running in fiber.callbacks)
        for running in (*self.suspended, *on_stacks):
            self._recorder.fact(running.node, UNFINISHED)

    def _running(self, work: Work) -> RunningCallback:
        """The record of a piece of work while it runs."""
        function, entity = work.names or work.call, work.entity
        if entity is None:
            name, group = callback_name(function), None
        else:
            group = entity.callback_group
            known, name = self._names.get(id(entity), (None, ""))
            if known is not function:
                name = callback_name(function)
                self._names[id(entity)] = function, name
        node = self._recorder.name_of(work.node)
        return RunningCallback(name, node, work.kind, self._scheduler.now, group)

    def _call(self, running: RunningCallback, function: Callable[..., Any], arguments: tuple) -> None:
        """Call a function as a callback: recorded with its duration and with the exception that leaves it."""
        stack = self._scheduler.current.callbacks
        stack.append(running)
        try:
            function(*arguments)
        except BaseException as error:
            self._recorder.error(error, running.name, running.node)
            raise
        finally:
            stack.pop()
            self._recorder.callback_returned(running)

    async def _recorded_coroutine(self, work: Work, running: RunningCallback) -> Any:
        self.suspended.append(running)
        try:
            return await work.call(*work.arguments)
        except BaseException as error:
            self._recorder.error(error, running.name, running.node)
            raise
        finally:
            self.suspended.remove(running)
            self._recorder.callback_returned(running)
            if running.group is not None:
                running.group.ending_execution(work.entity)

    def _resume(self, waiter: Waiter, work: Work) -> bool:
        task: Any = work.call
        before = _position(task)
        if inspect.iscoroutine(task._handler):
            self._step(task)
        else:  # a done callback of a future, or a function given to create_task()
            self._call(self._running(work), self._step, (task,))
        if task.done() or _position(task) != before:
            state_of(task).since = self._scheduler.now
            self._scheduler.student_code_ran()
            return True
        # It still waits for the same thing: poll it again when something has happened.
        state_of(task).seen_wakes = waiter.wakes
        return False

    def _step(self, task: Task) -> None:
        running, name = state_of(task).running, callback_name(task)
        stack = self._scheduler.current.callbacks
        if running is not None:
            stack.append(running)
        try:
            task()
        finally:
            if running is not None:
                stack.remove(running)
        if task.done() and task.exception() is not None:
            error = task.exception()
            self._recorder.error(error, name)
            raise error

    def recorded(self, function: Callable[..., Any], node: Any) -> Callable[..., Any]:
        """The same function, for callers that swallow what it raises: the exception is recorded before."""
        name, node_name = callback_name(function), self._recorder.name_of(node)

        def call(*arguments: Any) -> Any:
            try:
                return function(*arguments)
            except BaseException as error:
                self._recorder.error(error, name, node_name)
                raise

        async def call_later(*arguments: Any) -> Any:
            try:
                return await function(*arguments)
            except BaseException as error:
                self._recorder.error(error, name, node_name)
                raise

        return call_later if inspect.iscoroutinefunction(function) else call


def _position(task: Task) -> tuple[int, ...]:
    """Return where a suspended coroutine is, through everything it awaits."""
    place, coroutine = [], task._handler
    while inspect.iscoroutine(coroutine) and coroutine.cr_frame is not None:
        place.append(coroutine.cr_frame.f_lasti)
        coroutine = coroutine.cr_await
    return tuple(place)
