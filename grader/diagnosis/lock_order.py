"""Two locks of one node that are taken in both orders."""

from __future__ import annotations

import ast
import itertools
from collections.abc import Iterator
from typing import NamedTuple

from grader.diagnosis.student_nodes import StudentNode, student_nodes
from sim.evidence import Recording
from sim.notebook.attribute_analysis import called_names, own_attribute
from sim.notebook.class_source import Methods
from sim.notebook.name_analysis import looked_up_names
from sim.notebook.run_programs import run_programs

THREADS = {"MultiThreadedExecutor", "Thread", "ThreadPoolExecutor", "Timer"}


class Taken(NamedTuple):
    """A lock that is taken while others are held, as they are written in the code."""

    method: str  # where the first of them is taken
    held: tuple[str, ...]
    lock: str


def both_orders(recording: Recording) -> str:
    """Two locks of which one place takes the first and then the second, and another place the reverse.

    The program has threads, or an executor with threads. Locks are what `with self.name:` and
    `self.name.acquire()` take, also in methods that are called meanwhile. A third lock that both places hold
    around the two makes any order right, and so does a lock that is already held.
    """
    programs = run_programs(recording)
    for node in student_nodes(recording):
        names = {name for thing in (node.class_, *programs) for name in looked_up_names(thing)}
        for one, other in itertools.combinations(_all_taken(node), 2) if names & THREADS else ():
            crossed = one.lock in other.held and other.lock in one.held
            if crossed and not {*one.held} & {*other.held}:
                owner = node.class_.__name__
                return (
                    f"{owner}.{one.method} takes {other.lock}, then {one.lock}; {owner}.{other.method} takes "
                    f"{one.lock}, then {other.lock}. When both run at the same time, each can wait for the "
                    "lock that the other holds, and the node hangs for good, even if it did not in this run. "
                    "Take the two in the same order everywhere."
                )
    return ""


def _all_taken(node: StudentNode) -> list[Taken]:
    found: dict[Taken, None] = {}
    for name, method in node.methods.items():
        found |= dict.fromkeys(_taken(method.body, name, [], node.methods, frozenset({name})))
    return list(found)


def _taken(
    body: list[ast.stmt], method: str, held: list[str], methods: Methods, inside: frozenset[str]
) -> Iterator[Taken]:
    """The locks that statements take while others are held. held is changed in place."""
    for statement in body:
        locks: list[str] = []
        if isinstance(statement, ast.With | ast.AsyncWith):
            locks = [_lock(item.context_expr) for item in statement.items if _lock(item.context_expr)]
        elif isinstance(statement, ast.Expr | ast.Assign):
            change, lock = _acquired(statement.value)
            locks = [lock] if change == "acquire" else []
            if change == "release" and lock in held:
                held.remove(lock)
        added = [lock for lock in dict.fromkeys(locks) if lock not in held]
        for lock in added:
            if held:
                yield Taken(method, tuple(held), lock)
            held.append(lock)
        yield from _called(statement, method, held, methods, inside)
        for field in ("body", "orelse", "finalbody"):
            if not isinstance(statement, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
                yield from _taken(getattr(statement, field, []), method, held, methods, inside)
        if isinstance(statement, ast.With | ast.AsyncWith):
            held[:] = [lock for lock in held if lock not in added]


def _called(
    statement: ast.stmt, method: str, held: list[str], methods: Methods, inside: frozenset[str]
) -> Iterator[Taken]:
    """The locks that the methods take which a simple statement calls while locks are held."""
    if held and not hasattr(statement, "body"):
        for name in called_names(statement, methods):
            if name not in inside:
                yield from _taken(methods[name].body, method, [*held], methods, inside | {name})


def _lock(expression: ast.AST) -> str:
    """A lock as it is written in a `with`; "" for a call, which makes a context of its own."""
    named = own_attribute(expression) or (isinstance(expression, ast.Name) and expression.id.isupper())
    return ast.unparse(expression) if named else ""


def _acquired(value: ast.AST | None) -> tuple[str, str]:
    """ "acquire" or "release" and the lock, for a call of one of these; else two empty strings."""
    if isinstance(value, ast.Call) and isinstance(value.func, ast.Attribute):
        return value.func.attr, _lock(value.func.value)
    return "", ""
