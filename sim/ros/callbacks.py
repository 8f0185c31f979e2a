"""Running one callback: its group, its name, how long it took, and what it raised."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

from rclpy.task import Task

if TYPE_CHECKING:
    from sim.ros.engine import Engine

MAX_CALLBACKS_PER_INSTANT = 20_000


class Work(NamedTuple):
    """One callback that is ready. entity is None for a task that goes on."""

    kind: str
    entity: Any
    node: Any
    call: Callable[..., Any]
    arguments: tuple = ()
    names: Callable[..., Any] | None = None  # the function to name to the reader, if it isn't `call`


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


def perform(engine: Engine, executor: Any, work: Work, begun: bool = False) -> bool:
    """Run a callback to its end or its first await; False if it could not begin or go on.

    begun: its callback group knows of it already.
    """
    engine.count_callback()
    if work.entity is None:
        return _resume(engine, work)
    group = work.entity.callback_group
    if group is not None and not begun and not group.beginning_execution(work.entity):
        return False
    engine.activity += 1
    if inspect.iscoroutinefunction(work.call):
        task = Task(_recorded, (engine, work, group), executor=executor)
        executor._tasks.append((task, work.entity, work.node))
        _step(engine, task)
        return True
    try:
        with recording(engine, work):
            work.call(*work.arguments)
    finally:
        if group is not None:
            group.ending_execution(work.entity)
    return True


async def _recorded(engine: Engine, work: Work, group: Any) -> Any:
    try:
        with recording(engine, work):
            return await work.call(*work.arguments)
    finally:
        if group is not None:
            group.ending_execution(work.entity)


def _resume(engine: Engine, work: Work) -> bool:
    task = work.call
    before = _position(task)
    if inspect.iscoroutine(task._handler):
        _step(engine, task)
    else:  # a done callback of a future, or a function given to create_task()
        with recording(engine, work):
            _step(engine, task)
    if task.done() or _position(task) != before:
        engine.activity += 1
        return True
    task._sim_seen = (
        engine.activity
    )  # it still waits for the same thing: ask again when something has happened
    return False


def _step(engine: Engine, task: Task) -> None:
    task()
    if task.done() and task.exception() is not None:
        error = task.exception()
        engine.recorder.error(error, callback_name(task))
        raise error


def _position(task: Task) -> tuple[int, ...]:
    """Where a suspended coroutine stands, through everything it awaits."""
    place, coroutine = [], task._handler
    while inspect.iscoroutine(coroutine) and coroutine.cr_frame is not None:
        place.append(coroutine.cr_frame.f_lasti)
        coroutine = coroutine.cr_await
    return tuple(place)


@contextmanager
def recording(engine: Engine, work: Work) -> Iterator[None]:
    """Record a callback's name, node, duration in simulated time, and the exception that leaves it."""
    name = callback_name(work.names or work.call)
    node = engine.recorder.name_of(work.node)
    began, names = engine.now, engine.current.callbacks
    names.append((name, node, began))
    try:
        yield
    except BaseException as error:
        engine.recorder.error(error, name, node)
        raise
    finally:
        if (name, node, began) in names:
            names.remove((name, node, began))
        engine.recorder.callback(began, name, node, work.kind)
