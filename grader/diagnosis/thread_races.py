"""An attribute that two threads change, of which one writes back what it read before."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import Any

from grader.diagnosis.student_nodes import StudentNode, assignments, student_nodes
from sim.evidence import Recording
from sim.notebook.attribute_analysis import own_attribute, reached, reads
from sim.notebook.class_source import Methods, function_tree
from sim.notebook.run_programs import run_programs

OWN_GROUP = "MutuallyExclusiveCallbackGroup()"
_STARTS = ("Thread", "Timer", "submit", "run_in_executor", "start_new_thread")


def lost_update(recording: Recording) -> str:
    """Two methods that may run at the same time and change one attribute without a lock.

    One of them reads the attribute and writes it back, as `self.count += 1` does, and the other assigns it.
    They may run at the same time if one is the target of a thread, or if the program spins with several
    threads and the callback groups are different or reentrant. Whatever is inside a `with self.lock:` counts
    as protected. Callbacks count only if they ran.
    """
    functions = [function_tree(thing) for thing in run_programs(recording) if not isinstance(thing, type)]
    for node in student_nodes(recording):
        started = set(_thread_targets([*node.methods.values(), *filter(None, functions)], node.methods))
        several = any(map(_spins_with_threads, filter(None, functions)))
        for method, name in _updates(node):
            for other in _others(node, name):
                why = _together(node, method, other, started, several)
                if why:
                    return _lost_update(node.class_.__name__, method, other, name, why)
    return ""


def _lost_update(owner: str, method: str, other: str, name: str, why: str) -> str:
    both = "itself" if method == other else f"{owner}.{other}"
    return (
        f"{owner}.{method} reads self.{name} and writes it back, and may run at the same time as {both}, "
        f"which also changes it: {why}. A change that the other makes in between is lost. Change self.{name} "
        "only inside `with self.lock:`, with one threading.Lock() for the node."
    )


def _entries(node: StudentNode) -> list[str]:
    return [callback.split(".")[-1] for callback in node.uses]


def _updates(node: StudentNode) -> Iterator[tuple[str, str]]:
    """The callbacks and thread targets that read an attribute and write it back, each with the attribute."""
    for entry in _entries(node):
        for part in reached(entry, node.methods):
            free = _unprotected(part)
            for statement in free:
                name = _updated(statement, free)
                if name:
                    yield entry, name


def _updated(statement: ast.AST, around: list[ast.AST]) -> str:
    """The attribute that a statement writes back; "" if it does not."""
    if isinstance(statement, ast.AugAssign):
        return own_attribute(statement.target)
    if not isinstance(statement, ast.Assign) or not own_attribute(statement.targets[0]):
        return ""
    name = own_attribute(statement.targets[0])
    names = {part.id for part in ast.walk(statement.value) if isinstance(part, ast.Name)}
    earlier = [
        part.value
        for part in around
        if isinstance(part, ast.Assign)
        and part.lineno < statement.lineno
        and isinstance(part.targets[0], ast.Name)
        and part.targets[0].id in names
    ]
    return name if name in set(reads([statement.value, *earlier])) else ""


def _others(node: StudentNode, name: str) -> list[str]:
    """The callbacks and thread targets that assign an attribute."""
    return [
        entry
        for entry in _entries(node)
        if any(
            own_attribute(target) == name and isinstance(target.ctx, ast.Store)  # type: ignore[attr-defined]
            for part in reached(entry, node.methods)
            for target in ast.walk(part)
        )
    ]


def _unprotected(part: ast.AST) -> list[ast.AST]:
    """The nodes of a method that are in no `with` of an object, such as a lock, and before no `acquire`."""
    if any(
        isinstance(node, ast.Call) and getattr(node.func, "attr", "") == "acquire" for node in ast.walk(part)
    ):
        return []
    found: list[ast.AST] = []
    for child in ast.iter_child_nodes(part):
        if not isinstance(child, ast.With | ast.AsyncWith):
            found += [child, *_unprotected(child)]
    return found


def _thread_targets(functions: list[Any], methods: Methods) -> Iterator[str]:
    """The methods that are started in a thread of their own."""
    for function in functions:
        for call in ast.walk(function):
            called = getattr(call, "func", None)
            if getattr(called, "attr", getattr(called, "id", "")) in _STARTS:
                values = (*call.args, *(keyword.value for keyword in call.keywords))  # type: ignore[attr-defined]
                yield from (value.attr for value in values if getattr(value, "attr", "") in methods)


def _spins_with_threads(function: ast.AST) -> bool:
    """Return whether a program creates an executor with more than one thread."""
    for call in ast.walk(function):
        if isinstance(call, ast.Call) and ast.unparse(call.func).split(".")[-1] == "MultiThreadedExecutor":
            values = (*call.args[:1], *(k.value for k in call.keywords if k.arg == "num_threads"))
            return not any(isinstance(value, ast.Constant) and value.value == 1 for value in values)
    return False


def _together(node: StudentNode, one: str, other: str, started: set[str], several: bool) -> str:
    """Return why two methods may run at the same time; "" if they may not."""
    owner = node.class_.__name__
    callbacks = [name for name in (one, other) if name not in started]
    if any(
        f"{owner}.{name}" not in node.runs or f"{owner}.{name}" not in node.registered for name in callbacks
    ):
        return ""
    if one != other and len(callbacks) < 2:
        thread = one if one in started else other
        return f"{owner}.{thread} runs in a thread of its own"
    groups = [_group(node, f"{owner}.{name}") for name in callbacks]
    if several and len(groups) == 2 and None not in groups:
        if groups[0] != groups[1]:
            return "the executor has several threads, and the two have different callback groups"
        if "ReentrantCallbackGroup" in str(groups[0]):
            return "the executor has several threads, and the callback group is reentrant"
    return ""


def _group(node: StudentNode, callback: str) -> str | None:
    """Return what identifies a callback's group: its call and name; None if that is not in the code."""
    text = node.registered[callback].group
    if not text or text.endswith("()"):
        return f"{text} of {callback}" if text else OWN_GROUP
    for part in reached("__init__", node.methods):
        for target, value in assignments(part):
            if value is not None and ast.unparse(target) == text:
                return f"{ast.unparse(value)} in {text}"
    return None
