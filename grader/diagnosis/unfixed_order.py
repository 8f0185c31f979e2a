"""Callbacks of one node that use one attribute in an order that nothing fixes."""

from __future__ import annotations

import ast

from grader.diagnosis.student_nodes import StudentNode, assignments, student_nodes
from sim.evidence import Recording
from sim.notebook.attribute_analysis import own_attribute, reached
from sim.notebook.class_source import Function

START = 0.5  # s: by so much programs of a robot start earlier or later
_SENDS = ("publish", "call_async", "send_goal_async", "call", "send_goal")
# Functions that fail when they are called with None.
_NEEDS_VALUE = ("len", "float", "int", "abs", "round", "sum", "min", "max", "sorted", "publish")


def set_by_another(recording: Recording) -> str:
    """A callback that needs an attribute which another callback sets first, and does not test it.

    The attribute starts as None or does not exist, and None would fail where it is used. Both callbacks are
    registered in `__init__`, both ran, and their first executions were so close that a later start of one
    program would have exchanged them. Where the first sends what the second may be the answer to, the order
    is fixed.
    """
    for node in student_nodes(recording):
        for user, use in node.uses.items():
            for name in sorted(use.reads - use.writes - use.guarded):
                setter = _only_setter(node, name, user)
                if setter and _needs(node, user, name) and _was_luck(node, setter, user):
                    return _set_by_another(node, setter, user, name)
    return ""


def _set_by_another(node: StudentNode, setter: str, user: str, name: str) -> str:
    first, then = (node.runs[callback][0].stamp for callback in (setter, user))
    missing = "starts as None" if _initial(node, name) else "does not exist before that"
    test = f"`if self.{name} is None: return`"
    advice = f"Begin {user} with {test}"
    if not _initial(node, name):
        advice = f"Set self.{name} = None in __init__, and begin {user} with {test}"
    return (
        f"{user} uses self.{name}, which only {setter} sets and which {missing}. Nothing determines which of "
        f"the two runs first; in this run {setter} did, at {first:.3g} s, and {user} at {then:.3g} s. "
        f"{advice}."
    )


def _only_setter(node: StudentNode, name: str, user: str) -> str:
    """The callback that alone writes an attribute after `__init__` left it empty; "" if there is none."""
    writers = node.writers(name)
    reads_nothing_else = len(writers) == 1 and user in node.registered and writers[0] in node.registered
    if not reads_nothing_else or _initial(node, name) is False or hasattr(node.class_, name):
        return ""
    known = {id(part) for part in (*node.parts(writers[0]), *reached("__init__", node.methods))}
    others = [m for m in node.methods.values() if id(m) not in known and name in _stored(m)]
    guarded_too = node.uses[user].guarded & node.uses[writers[0]].writes
    return "" if others or guarded_too else writers[0]


def _initial(node: StudentNode, name: str) -> bool | None:
    """Return whether `__init__` sets an attribute to None; None if it does not set it."""
    found: bool | None = None
    for part in reached("__init__", node.methods):
        for target, value in assignments(part):
            if own_attribute(target) == name:
                empty = isinstance(value, ast.Constant) and value.value is None
                found = empty and found is not False
    return found


def _stored(method: Function) -> set[str]:
    return {
        own_attribute(node) for node in ast.walk(method) if isinstance(getattr(node, "ctx", None), ast.Store)
    }


def _needs(node: StudentNode, user: str, name: str) -> bool:
    """Return whether a callback fails if the attribute is None, or is not there."""
    if _initial(node, name) is None:
        return True
    return any(_fails_with_none(part, name) for part in node.parts(user))


def _fails_with_none(part: ast.AST, name: str) -> bool:
    aliases = {
        target.id
        for target, value in assignments(part)
        if isinstance(target, ast.Name) and value is not None and own_attribute(value) == name
    }

    def is_it(node: ast.AST | None) -> bool:
        return node is not None and (
            own_attribute(node) == name or (isinstance(node, ast.Name) and node.id in aliases)
        )

    return any(any(map(is_it, _operands(node))) for node in ast.walk(part))


def _operands(node: ast.AST) -> list[ast.AST]:
    """The parts of an expression or loop that must not be None."""
    if isinstance(node, ast.Attribute | ast.Subscript | ast.Starred):
        return [node.value]
    if isinstance(node, ast.BinOp):
        return [] if isinstance(node.op, ast.Mod) else [node.left, node.right]
    if isinstance(node, ast.UnaryOp):
        return [] if isinstance(node.op, ast.Not) else [node.operand]
    if isinstance(node, ast.For | ast.comprehension):
        return [node.iter]
    if isinstance(node, ast.Call):
        function = ast.unparse(node.func)
        strict = function.startswith("math.") or function.split(".")[-1] in _NEEDS_VALUE
        return [node.func, *(node.args if strict else ())]
    return []


def _was_luck(node: StudentNode, setter: str, user: str) -> bool:
    """Return whether another start of the programs would have exchanged the first executions."""
    if setter not in node.runs or user not in node.runs:
        return False
    if node.registered[user].kind != "timer" and _sends(node, setter):
        return False
    return 0 <= node.runs[user][0].stamp - node.runs[setter][0].stamp <= START


def _sends(node: StudentNode, callback: str) -> bool:
    calls = (call for part in node.parts(callback) for call in ast.walk(part))
    return any(isinstance(call, ast.Call) and getattr(call.func, "attr", "") in _SENDS for call in calls)


def equal_timers(recording: Recording) -> str:
    """Two timers of one period that fire together, of which one uses at once what the other sets.

    The reader publishes in the same callback, and neither tests the attribute.
    """
    for node in student_nodes(recording):
        timers = [callback for callback, row in node.registered.items() if row.kind == "timer"]
        for setter in timers:
            for user in timers:
                name = _shared(node, setter, user)
                period = _common_period(recording, node, setter, user) if name else 0.0
                if period:
                    return (
                        f"{setter} sets self.{name}, and {user} uses it. Both are timers of {node.name} with "
                        f"a period of {period:g} s. The current rclpy first runs the one that was created "
                        f"first, but nothing guarantees that: {user} gets the value of this period or of the "
                        "one before. Do both in one callback, in the order that they need."
                    )
    return ""


def _shared(node: StudentNode, setter: str, user: str) -> str:
    """The first attribute that one timer alone sets, and that another uses."""
    sets, use = node.uses[setter].writes, node.uses[user]
    names = (use.reads - use.writes - use.guarded) & sets if setter != user and _sends(node, user) else set()
    return next((name for name in sorted(names) if node.writers(name) == [setter]), "")


def _common_period(recording: Recording, node: StudentNode, setter: str, user: str) -> float:
    """The period of two timers that always fired at the same moments; 0.0 if they differ."""
    periods = {t.callback: t.period for t in recording.graph.timers if t.node == node.name}
    one, other = (
        [run.stamp for run in node.runs.get(callback, ()) if run.kind == "timer"]
        for callback in (setter, user)
    )
    together = bool(one) and one == other
    return periods.get(setter, 0.0) if together and periods.get(setter) == periods.get(user) else 0.0
