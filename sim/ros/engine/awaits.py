"""Futures that coroutines await in vain: nothing has them, or only callbacks that can't run meanwhile."""

from __future__ import annotations

import ast
import gc
import inspect
import linecache
import sys
import weakref
from collections.abc import Callable, Iterable
from functools import partial
from types import CellType, FrameType, FunctionType, GeneratorType, ModuleType
from typing import Any, NamedTuple

from rclpy.action import ActionClient, ActionServer
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.client import Client
from rclpy.node import Node
from rclpy.task import Future

from sim.nanoseconds import SECOND, Nanoseconds
from sim.notebook.attribute_analysis import own_attribute, reached
from sim.notebook.class_source import Methods, methods_of
from sim.ros.engine.callbacks import state_of
from sim.ros.recorder.running import callback_name
from sim.ros.recorder.tracebacks import is_library, student_line

_COMPLETES = ("set_result", "set_exception", "cancel")


class Awaiting(NamedTuple):
    """A callback that awaits a future. place: where, as the end of a sentence."""

    name: str
    node: Any
    group: Any  # the callback group that it occupies; None for an action's execute callback
    since: Nanoseconds
    future: Future
    place: str
    chain: list[Any]  # its coroutine, and what that awaits


def useless_await(executors: Iterable[Any], now: Nanoseconds, patience: Nanoseconds, of: Callable) -> str:
    """The first callback that has awaited in vain for longer than `patience`, in a sentence; "" for none.

    of: gives a node's name.
    """
    for waiting in (each for executor in executors for each in _awaiting(executor)):
        why = _why_in_vain(waiting) if now - waiting.since >= patience else ""
        if why:
            since = waiting.since / SECOND
            what = f"{waiting.name} of node {of(waiting.node)} has waited since t = {since:g} s"
            return f"{what} and never returned{waiting.place}. {why}"
    return ""


def waits_for_a_future(task: Any) -> bool:
    """Return whether a coroutine awaits a future that isn't complete: to poll it would change nothing."""
    future = _awaited(_chain(task._handler))
    return future is not None and not (future.done() or future.cancelled())


def _awaiting(executor: Any) -> list[Awaiting]:
    """The callbacks of an executor, and execute callbacks of actions, that await a plain future."""
    found = []
    for task, entity, node in executor._tasks:
        chain = _chain(task._handler)
        future = _awaited(chain)
        server = chain[0].cr_frame.f_locals.get("self") if len(chain) > 1 else None
        node = server._node if isinstance(server, ActionServer) else node
        if node is not None and type(future) is Future:
            running, place = state_of(task).running, student_line(_students_frame(chain))
            name = callback_name(task) if running is None else running.name
            group = None if entity is None else entity.callback_group
            found.append(Awaiting(name, node, group, state_of(task).since, future, place, chain))
    return found


def _chain(coroutine: Any) -> list[Any]:
    """A coroutine, what it awaits, what that awaits, and so on."""
    chain = [coroutine]
    while inspect.iscoroutine(chain[-1]) and chain[-1].cr_await is not None:
        chain.append(chain[-1].cr_await)
    return chain


def _awaited(chain: list[Any]) -> Any:
    """Return the future that the last of a chain awaits; None if that is something else."""
    return chain[-1].gi_frame.f_locals.get("self") if _is_await(chain[-1]) else None


def _is_await(awaited: Any) -> bool:
    is_running = isinstance(awaited, GeneratorType) and awaited.gi_frame is not None
    return is_running and awaited.gi_code is Future.__await__.__code__


def _students_frame(chain: list[Any]) -> FrameType | None:
    frames = [each.cr_frame for each in chain if inspect.iscoroutine(each)]
    own = [frame for frame in frames if not is_library(frame.f_code.co_filename)]
    return own[-1] if own else None


def _why_in_vain(waiting: Awaiting) -> str:
    """Return why a future is never completed, as far as that is certain; else ""."""
    owners = [getattr(each, "__self__", None) for each in waiting.future._callbacks]
    if any(isinstance(owner, Client | ActionClient) for owner in owners):
        return ""  # a response completes it, if a server takes the request
    holders = [each for each in gc.get_referrers(waiting.future) if not _is_own(each, waiting)]
    held = holders or weakref.getweakrefs(waiting.future)
    if not held or not _source_completes(waiting):
        return "It awaits a future that no code completes: nothing calls its set_result()."
    completing = [*_by_closures(holders, waiting), *_by_methods(holders, waiting)]
    exclusive = isinstance(waiting.group, MutuallyExclusiveCallbackGroup)
    if completing and exclusive and all(each.callback_group is waiting.group for each in completing):
        name = callback_name(completing[0].callback)
        return (
            f"It awaits a future that only {name} can complete, and that is in the same callback group, so "
            f"it can run only after {waiting.name} has returned."
        )
    return ""


def _is_own(holder: Any, waiting: Awaiting) -> bool:
    """Return whether it is the awaiting code itself with its variables, or this look at it."""
    frames = [getattr(each, "cr_frame", None) or each.gi_frame for each in waiting.chain]
    own = (waiting, *waiting.chain, *(frame.f_locals for frame in frames))
    return isinstance(holder, FrameType) or any(holder is each for each in own)


def _source_completes(waiting: Awaiting) -> bool:
    """Return whether code that may have the future completes any; no library completes a plain future."""
    frame = _students_frame(waiting.chain)
    texts = [] if frame is None else ["".join(linecache.getlines(file)) for file in _files(frame)]
    return not any(texts) or any(f".{name}" in text for text in texts for name in _COMPLETES)


def _files(frame: FrameType) -> set[str]:
    """The file of some code, those of the modules that use its module, and in a notebook all cells."""
    module, files = frame.f_globals.get("__name__"), {frame.f_code.co_filename}
    if module == "__main__":
        files |= {file for file in list(linecache.cache) if not is_library(file)}
    for other in list(sys.modules.values()):
        file = getattr(other, "__file__", None)
        if isinstance(file, str) and not is_library(file) and _uses(other, module):
            files.add(file)
    return files


_NAMED = (type, FunctionType, ModuleType)  # what knows in which module it was defined


def _uses(other: ModuleType, module: str | None) -> bool:
    # By their types: an object of a student's class may raise when it is asked for its `__class__`.
    values = [each for each in list(vars(other).values()) if issubclass(type(each), _NAMED)]
    return any(_text_of(each, name) == module for each in values for name in ("__name__", "__module__"))


def _text_of(thing: Any, name: str) -> str:
    """An attribute that is a text; "" without one, and for a metaclass that raises."""
    try:
        value = getattr(thing, name, "")
    except Exception:  # of a student's metaclass
        return ""
    return value if type(value) is str else ""


def _entities(node: Node) -> list[Any]:
    ends = (*node.timers, *node.subscriptions, *node.services)
    return [end for end in ends if getattr(end, "callback", None) is not None]


def _by_closures(holders: list[Any], waiting: Awaiting) -> list[Any]:
    """The timers and the like whose callbacks have the future as a variable; nothing if others have it."""
    cells = [each for each in holders if isinstance(each, CellType)]
    if not cells or len(cells) < len(holders):
        return []
    return [end for end in _entities(waiting.node) if any(_has_cell(end.callback, cell) for cell in cells)]


def _has_cell(callback: Any, cell: CellType) -> bool:
    while isinstance(callback, partial):
        callback = callback.func
    return any(each is cell for each in getattr(callback, "__closure__", None) or ())


def _by_methods(holders: list[Any], waiting: Awaiting) -> list[Any]:
    """The timers and the like whose methods complete the future, if it is an attribute of their node."""
    node = waiting.node
    names = [name for name, value in vars(node).items() if value is waiting.future]
    if len(names) != 1 or any(each is not node and each is not vars(node) for each in holders):
        return []
    methods = methods_of(type(node))
    ends = [end for end in _entities(node) if getattr(end.callback, "__self__", None) is node]
    completing = [end for end in ends if _completes(end.callback.__name__, names[0], methods)]
    called = {end.callback.__name__ for end in completing}
    setters = [name for name in methods if _completes(name, names[0], {name: methods[name]})]
    reachable = {part.name for name in called for part in reached(name, methods)}
    return completing if reachable.issuperset(setters) else []


def _completes(method: str, attribute: str, methods: Methods) -> bool:
    return any(
        isinstance(part, ast.Attribute) and part.attr in _COMPLETES and own_attribute(part.value) == attribute
        for each in reached(method, methods)
        for part in ast.walk(each)
    )
