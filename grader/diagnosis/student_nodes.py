"""The source of a student's nodes, together with what the recording of their run shows of them."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

from sim.evidence import CallbackRun, Endpoint, Recording
from sim.notebook.attribute_analysis import AttributeUse, attributes_of, own_attribute, reached
from sim.notebook.class_source import Function, Methods, methods_of
from sim.notebook.run_programs import run_programs

_KINDS = {
    "create_subscription": "subscription",
    "create_timer": "timer",
    "create_service": "service",
}


class Registration(NamedTuple):
    """A method that the node's `__init__` passes to ROS as a callback."""

    kind: str  # subscription, timer or service
    topic: str  # the name in the code; "" where it is computed, and for a timer
    group: str  # the expression for its callback group; "" for the node's own


@dataclass(frozen=True)
class StudentNode:
    """A node of the student's whose callbacks ran, with the source of its class."""

    name: str  # full name
    class_: type
    methods: Methods
    uses: dict[str, AttributeUse]  # by callback, such as "Pairs.on_b"
    registered: dict[str, Registration]  # by callback
    runs: dict[str, list[CallbackRun]]  # by callback, in the order of the run
    subscriptions: list[Endpoint]

    def parts(self, callback: str) -> list[Function]:
        """A callback's method, and those that it calls."""
        return reached(callback.split(".")[-1], self.methods)

    def writers(self, attribute: str) -> list[str]:
        """The callbacks that write an attribute."""
        return [callback for callback, use in self.uses.items() if attribute in use.writes]

    def subscription(self, callback: str) -> Endpoint | None:
        """The subscription that calls this callback; None if the code doesn't show it."""
        topic = self.registered[callback].topic.strip("/") if callback in self.registered else ""
        ends = [end for end in self.subscriptions if topic and end.name.endswith(f"/{topic}")]
        return ends[0] if len(ends) == 1 else None


def student_nodes(recording: Recording) -> Iterator[StudentNode]:
    """The student's nodes whose classes are known; none for a recording from a file or another process."""
    classes = _classes(run_programs(recording))
    runs: dict[str, dict[str, list[CallbackRun]]] = {}
    for run in recording.callbacks:
        if run.node not in recording.course_nodes:
            runs.setdefault(run.node, {}).setdefault(run.callback, []).append(run)
    for name, by_callback in runs.items():
        owners = {callback.rpartition(".")[0] for callback in by_callback} & classes.keys()
        for owner in sorted(owners):
            class_, methods = classes[owner], methods_of(classes[owner])
            if "__init__" in methods:
                subscriptions = [end for end in recording.graph.subscriptions() if end.node == name]
                registered = _registered(owner, methods)
                uses = attributes_of(class_)
                yield StudentNode(name, class_, methods, uses, registered, by_callback, subscriptions)


def node_classes(recording: Recording) -> list[type]:
    """The classes of nodes that the student's programs are or use; none for a recording as above."""
    classes = _classes(run_programs(recording)).values()
    return [class_ for class_ in classes if hasattr(class_, "create_publisher")]


def assignments(part: ast.AST) -> Iterator[tuple[ast.AST, ast.AST | None]]:
    """Each target that this code assigns, with its value; None for a value that is not in the code."""
    for statement in ast.walk(part):
        if isinstance(statement, ast.AnnAssign) and statement.value is not None:
            yield statement.target, statement.value
        elif isinstance(statement, ast.AugAssign | ast.For):
            yield statement.target, None
        elif isinstance(statement, ast.Assign):
            for target in statement.targets:
                if isinstance(target, ast.Tuple):
                    same = isinstance(statement.value, ast.Tuple) and len(statement.value.elts)
                    values = statement.value.elts if same == len(target.elts) else [None] * len(target.elts)  # type: ignore[attr-defined]
                    yield from zip(target.elts, values, strict=True)
                else:
                    yield target, statement.value


def _classes(programs: tuple[Any, ...]) -> dict[str, type]:
    """The classes that these programs are or use, by name."""
    found = {program.__name__: program for program in programs if isinstance(program, type)}
    for program in programs:
        around = getattr(program, "__globals__", {})
        found = {name: value for name, value in around.items() if isinstance(value, type)} | found
    return found


def _registered(owner: str, methods: Methods) -> dict[str, Registration]:
    found: dict[str, Registration] = {}
    for part in reached("__init__", methods):
        for call in ast.walk(part):
            kind = _KINDS.get(getattr(getattr(call, "func", None), "attr", ""))
            if not isinstance(call, ast.Call) or kind is None:
                continue
            named = {keyword.arg: keyword.value for keyword in call.keywords}
            topic = named.get("topic", call.args[1] if len(call.args) > 1 else None)
            known = str(topic.value) if kind != "timer" and isinstance(topic, ast.Constant) else ""
            group = ast.unparse(named["callback_group"]) if "callback_group" in named else ""
            for value in (*call.args, *named.values()):
                if own_attribute(value) in methods:
                    row = Registration(kind, known, group)
                    found[f"{owner}.{own_attribute(value)}"] = row
    return found
