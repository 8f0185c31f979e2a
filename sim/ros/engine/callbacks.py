"""Running one callback: its group, its name, how long it took, and what it raised."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from rclpy.task import Task

from sim.ros.recorder.running import RunningCallback, callback_name

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine


class Work(NamedTuple):
    """One callback that is ready. entity is None for a task that goes on."""

    kind: str
    entity: Any
    node: Any
    call: Callable[..., Any]
    arguments: tuple = ()
    names: Callable[..., Any] | None = None  # the function to name to the reader, if it isn't `call`


@dataclass(slots=True)
class TaskState:
    """What a run keeps of a task: the callback that it is, if it is one; and what it has seen in vain."""

    running: RunningCallback | None = None
    seen: int | None = None  # the engine's `activity` when it waited last


def state_of(task: Task) -> TaskState:
    """What the run keeps of a task."""
    kept = task.__dict__.get("_sim")
    if kept is None:
        kept = task._sim = TaskState()
    return kept


def _running(engine: Engine, work: Work) -> RunningCallback:
    """What a piece of work is called while it runs."""
    function, entity = work.names or work.call, work.entity
    if entity is None:
        name, group = callback_name(function), None
    else:
        group = entity.callback_group
        known, name = engine.names.get(id(entity), (None, ""))
        if known is not function:
            name = callback_name(function)
            engine.names[id(entity)] = function, name
    return RunningCallback(name, engine.recorder.name_of(work.node), work.kind, engine.now, group)


def is_coroutine_function(function: Any) -> bool:
    """As `inspect.iscoroutinefunction`, which is slow, for the functions that callbacks mostly are."""
    code = getattr(function, "__code__", None)
    return (
        bool(code.co_flags & inspect.CO_COROUTINE)
        if code is not None
        else inspect.iscoroutinefunction(function)
    )


def perform(engine: Engine, executor: Any, work: Work, begun: bool = False) -> bool:
    """Run a callback to its end or its first await; False if it could not begin or go on.

    begun: its callback group knows of it already.
    """
    engine.limits.count_callback()
    if work.entity is None:
        engine.eager = True
        return _resume(engine, work)
    group = work.entity.callback_group
    if group is not None and not begun and not group.beginning_execution(work.entity):
        return False
    engine.student_code_ran()
    if is_coroutine_function(work.call):
        engine.eager = True
        running = _running(engine, work)
        task = Task(_recorded, (engine, work, running), executor=executor)
        state_of(task).running = running
        executor._tasks.append((task, work.entity, work.node))
        _step(engine, task)
        return True
    try:
        _call(engine, _running(engine, work), work.call, work.arguments)
    finally:
        if group is not None:
            group.ending_execution(work.entity)
    return True


def _call(engine: Engine, running: RunningCallback, function: Callable[..., Any], arguments: tuple) -> None:
    """Call a function as a callback: recorded with its duration and with the exception that leaves it."""
    stack = engine.current.callbacks
    stack.append(running)
    try:
        function(*arguments)
    except BaseException as error:
        engine.recorder.error(error, running.name, running.node)
        raise
    finally:
        stack.pop()
        engine.recorder.callback(running)


async def _recorded(engine: Engine, work: Work, running: RunningCallback) -> Any:
    engine.suspended.append(running)
    try:
        return await work.call(*work.arguments)
    except BaseException as error:
        engine.recorder.error(error, running.name, running.node)
        raise
    finally:
        engine.suspended.remove(running)
        engine.recorder.callback(running)
        if running.group is not None:
            running.group.ending_execution(work.entity)


def _resume(engine: Engine, work: Work) -> bool:
    task = work.call
    before = _position(task)
    if inspect.iscoroutine(task._handler):
        _step(engine, task)
    else:  # a done callback of a future, or a function given to create_task()
        _call(engine, _running(engine, work), _step, (engine, task))
    if task.done() or _position(task) != before:
        engine.activity += 1
        return True
    # It waits for the same thing still: ask again when something has happened.
    state_of(task).seen = engine.activity
    return False


def _step(engine: Engine, task: Task) -> None:
    running, name = state_of(task).running, callback_name(task)
    stack = engine.current.callbacks
    if running is not None:
        stack.append(running)
    try:
        task()
    finally:
        if running is not None:
            stack.remove(running)
    if task.done() and task.exception() is not None:
        error = task.exception()
        engine.recorder.error(error, name)
        raise error


def _position(task: Task) -> tuple[int, ...]:
    """Where a suspended coroutine stands, through everything it awaits."""
    place, coroutine = [], task._handler
    while inspect.iscoroutine(coroutine) and coroutine.cr_frame is not None:
        place.append(coroutine.cr_frame.f_lasti)
        coroutine = coroutine.cr_await
    return tuple(place)


def recorded(engine: Engine, function: Callable[..., Any], node: Any) -> Callable[..., Any]:
    """The same function, for callers that swallow what it raises: the exception is recorded before."""
    name, of = callback_name(function), engine.recorder.name_of(node)

    def call(*arguments: Any) -> Any:
        try:
            return function(*arguments)
        except BaseException as error:
            engine.recorder.error(error, name, of)
            raise

    async def call_later(*arguments: Any) -> Any:
        try:
            return await function(*arguments)
        except BaseException as error:
            engine.recorder.error(error, name, of)
            raise

    return call_later if inspect.iscoroutinefunction(function) else call
