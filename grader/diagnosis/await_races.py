"""A test whose result is used after an `await`, although another callback changed what was tested."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import NamedTuple

from grader.diagnosis.student_nodes import StudentNode, student_nodes
from sim.evidence import CallbackRun, Recording
from sim.notebook.attribute_analysis import AttributeUse, called_names, own_attribute, reached, reads, writes

EXACT = 1e-6  # s: moments that are closer are the same
_Place = tuple[int, int]  # line and column
_EXITS = (ast.Return, ast.Raise, ast.Continue, ast.Break)


class Condition(NamedTuple):
    """A condition that reads an attribute, and the statement that it belongs to."""

    place: _Place
    statement: ast.If | ast.While


def used_after_await(recording: Recording) -> str:
    """A callback that tests an attribute, awaits, and then uses it, while another callback changed it.

    The attribute is neither tested again after the `await` nor changed between the test and the `await`,
    which claims it; and in the run a callback that writes it was executed during the `await`. An `await` in
    a branch that makes the condition true, as in `if self.pose is None: await self.first_pose`, is fine.
    """
    for node in student_nodes(recording):
        for callback, use in node.uses.items():
            name = next(iter(_changeable(node, callback, use)), "")
            changed = _changed(node, callback, name) if name else None
            if changed:
                what = changed.callback
                other = f"another execution of {what}" if what == callback else what
                return (
                    f"{callback} tests self.{name}, awaits, and then uses self.{name}; during the await, at "
                    f"{changed.stamp:.3g} s, {other} changed it. The result of the test may no longer hold. "
                    f"Test self.{name} again after the await, or change it before the await."
                )
    return ""


def _changeable(node: StudentNode, callback: str, use: AttributeUse) -> Iterator[str]:
    """The attributes that a coroutine tests before an `await` and uses after it."""
    for method in node.parts(callback):
        if isinstance(method, ast.AsyncFunctionDef):
            for name in sorted(use.guarded):
                if _is_stale(method, name, node) and node.writers(name):
                    yield name


def _is_stale(method: ast.AsyncFunctionDef, name: str, node: StudentNode) -> bool:
    first, last = method.lineno, method.end_lineno or method.lineno
    if any(not first <= getattr(part, "lineno", first) <= last for part in ast.walk(method)):
        return False  # with the body of an overridden method in it, places are in no order
    tests = [
        Condition(_place(part), part)
        for part in ast.walk(method)
        if isinstance(part, ast.If | ast.While) and name in _tested(part.test, node)
    ]
    retests = [test.place for test in tests]
    # After its end, the condition of a loop has been tested again.
    retests += [
        (test.statement.end_lineno or 0, test.statement.end_col_offset or 0)
        for test in tests
        if isinstance(test.statement, ast.While)
    ]
    written = [_place(part) for part in ast.walk(method) if name in set(writes([_only(part)]))]
    inside = {id(part) for test in tests for part in ast.walk(test.statement.test)}
    uses = [
        _place(part) for part in ast.walk(method) if own_attribute(part) == name and id(part) not in inside
    ]
    awaits = [part for part in ast.walk(method) if isinstance(part, ast.Await)]
    return any(
        test.place < _place(wait) < use
        and not any(test.place < at < _place(wait) for at in written)
        and not any(_place(wait) < at <= use for at in retests)
        and _reaches(method, test.statement, wait, use)
        for test in tests
        for wait in awaits
        for use in uses
    )


def _tested(condition: ast.AST, node: StudentNode) -> set[str]:
    called = called_names(condition, node.methods)
    return {*reads([condition, *(part for name in called for part in reached(name, node.methods))])}


def _only(part: ast.AST) -> ast.AST:
    """A statement without the statements in it; other nodes give nothing."""
    simple = isinstance(part, ast.stmt) and not hasattr(part, "body")
    return part if simple else ast.Pass()


def _reaches(method: ast.AST, test: ast.If | ast.While, wait: ast.AST, use: _Place) -> bool:
    """Return whether execution can go from the test over the `await` to this use."""
    in_test = _contains(test, _place(wait))
    if in_test and not _contains(test, use):
        return False  # the branch waits until the condition is different
    for part in ast.walk(method):
        for block in (getattr(part, field, []) for field in ("body", "orelse", "finalbody")):
            if not isinstance(block, list) or not block or not _in_block(block, _place(wait)):
                continue
            other = [b for b in (getattr(part, "body", []), getattr(part, "orelse", [])) if b is not block]
            if isinstance(part, ast.If) and any(_in_block(b, use) for b in other if b):
                return False
            if isinstance(block[-1], _EXITS) and not _in_block(block, use):
                return False
    return True


def _in_block(block: list[ast.stmt], place: _Place) -> bool:
    return _place(block[0]) <= place <= (block[-1].end_lineno, block[-1].end_col_offset)


def _contains(part: ast.stmt, place: _Place) -> bool:
    return _in_block([part], place)


def _place(part: ast.AST) -> _Place:
    return getattr(part, "lineno", 0), getattr(part, "col_offset", 0)


def _changed(node: StudentNode, callback: str, name: str) -> CallbackRun | None:
    """The first execution of a callback that writes an attribute while this callback awaited.

    It began meanwhile, or with it and ended meanwhile; its `stamp` is when it began or ended in the await.
    """
    for run in node.runs.get(callback, ()):
        for writer in node.writers(name):
            for other in node.runs.get(writer, ()):
                for stamp in (other.stamp, other.stamp + other.duration):
                    inside = run.stamp + EXACT < stamp < run.stamp + run.duration - EXACT
                    if inside and other is not run and other.stamp > run.stamp - EXACT:
                        return other._replace(stamp=stamp)
    return None
