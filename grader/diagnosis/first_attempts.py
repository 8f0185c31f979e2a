"""Mistakes of a first node that raise no error: they explain why nothing, or little, was published."""

from __future__ import annotations

import ast

from grader.diagnosis.student_nodes import StudentNode, assignments, student_nodes
from sim.evidence import INFRASTRUCTURE_TOPICS, CallbackRun, Endpoint, Recording
from sim.notebook.attribute_analysis import own_attribute
from sim.notebook.class_source import Function

KINDS = ("timer", "subscription")  # of callbacks that may publish, the likelier first
MAX_FIRES = 2  # a timer that fired no more often in a whole run may have the wrong period
MIN_PERIOD = 5.0  # s
INPUTS = ("subscription", "service")  # kinds of callbacks that others cause
# Methods that check whether another node is there, has sent something, or needs it.
QUESTIONS = {"get_parameter", "can_transform", "service_is_ready", "server_is_ready", "services_are_ready"}
QUESTIONS |= {
    "count_publishers",
    "count_subscribers",
    "lookup_transform",
    "wait_for_service",
    "wait_for_server",
}
QUESTIONS |= {"count_clients", "count_services", "get_node_names", "get_node_names_and_namespaces"}
QUESTIONS |= {"get_publishers_info_by_topic", "get_subscriptions_info_by_topic", "get_topic_names_and_types"}
# Methods and functions whose value changes by itself.
CHANGES = {"now", "time", "monotonic", "is_ready", "random", "randint", "uniform", "choice"}
ORDERS = (ast.Lt, ast.LtE, ast.Gt, ast.GtE)


def publish_not_reached(recording: Recording) -> str:
    """A node that never published anything, although its callbacks ran: `publish` is not reached.

    A lifecycle node publishes only when it is active, and another program may activate it later.
    """
    used = {message.sender for message in recording.messages()}
    for end in recording.graph.publishers():
        if end.node in used or end.node in recording.course_nodes or end.name in INFRASTRUCTURE_TOPICS:
            continue
        runs = [run for run in recording.callbacks if run.node == end.node]
        ran = next(filter(None, ([run for run in runs if run.kind == kind] for kind in KINDS)), [])
        lifecycle = any(e.name == f"{end.node}/change_state" for e in recording.graph.ends("service"))
        if ran and not lifecycle and not _may_wait(recording, end, ran[0]):
            count = _times(ran, ran[0].callback)
            return (
                f"{end.node} has a publisher on {end.name}, but never publishes: {ran[0].callback} ran "
                f"{count}, and publish() was never reached. Look for an `if` that is never true, a `return` "
                "before it, or a method that is never called; a print in front of it shows which."
            )
    return ""


def _may_wait(recording: Recording, end: Endpoint, ran: CallbackRun) -> bool:
    """Return whether the code publishes only for subscribers, but there are none, or after some input."""
    node = next((node for node in student_nodes(recording) if node.name == end.node), None)
    if node is None or ran.callback not in node.uses:
        return True
    if any(callback not in node.runs and _publishes(node.parts(callback)) for callback in node.uses):
        return True
    methods = node.parts(ran.callback)
    tests = [test for method in methods for part in ast.walk(method) for test in _decisive(part)]
    parts = [part for test in tests for part in ast.walk(test)]
    local = {part.id for part in parts if isinstance(part, ast.Name)}
    parts += [
        part
        for method in methods
        for target, value in assignments(method)
        if value is not None and isinstance(target, ast.Name) and target.id in local
        for part in ast.walk(value)
    ]
    calls = {getattr(part, "attr", "") for part in parts}
    if "get_subscription_count" in calls:
        return not recording.graph.subscriptions(end.name)
    changing = bool(calls & (QUESTIONS | CHANGES)) or any(isinstance(part, ast.Mod) for part in parts)
    return changing or any(_is_input(node, ran, part) for part in parts)


def _publishes(methods: list[Function]) -> bool:
    return any(getattr(part, "attr", "") == "publish" for method in methods for part in ast.walk(method))


def _decisive(part: ast.AST) -> list[ast.expr]:
    """The expressions that decide whether the code inside a statement is executed."""
    if isinstance(part, ast.If | ast.IfExp | ast.While):
        return [part.test]
    if isinstance(part, ast.Match):
        return [part.subject, *(case.guard for case in part.cases if case.guard is not None)]
    if isinstance(part, ast.Try):
        return [inner.value for inner in part.body if isinstance(inner, ast.Assign | ast.Expr)]
    if isinstance(part, ast.Return):  # of a method that an expression calls
        return [part.value] if part.value is not None else []
    return [part.iter] if isinstance(part, ast.For) else []


def _is_input(node: StudentNode, ran: CallbackRun, part: ast.AST) -> bool:
    """Return whether it is an attribute that another callback writes for its input, or a message's limit."""
    name = own_attribute(part)
    if name:
        writers = [
            node.registered.get(callback) for callback in node.writers(name) if callback != ran.callback
        ]
        return any(row is not None and row.kind in INPUTS for row in writers)
    limit = isinstance(part, ast.Compare) and any(isinstance(each, ORDERS) for each in part.ops)
    return limit and ran.kind == "subscription"


def long_period(recording: Recording) -> str:
    """A node's only timer, with a period of whole seconds, fired not more than twice in the run."""
    for timer in recording.graph.timers:
        if timer.node in recording.course_nodes or timer.period < MIN_PERIOD or timer.period % 1.0:
            continue
        others = [row for row in recording.callbacks if row.node == timer.node and row.kind != "timer"]
        if others or sum(other.node == timer.node for other in recording.graph.timers) > 1:
            continue
        fired = [run for run in recording.callbacks if run.node == timer.node and run.kind == "timer"]
        due = int(recording.ended.stamp / timer.period + 1e-6)
        if len(fired) <= MAX_FIRES and len(fired) == due:
            name, tenth = timer.callback, timer.period / 10
            ran = f"ran {_times(fired, name)}" if fired else f"would run at {timer.period:g} s, and never ran"
            return (
                f"The timer of {timer.node} has a period of {timer.period:g} s: {name} {ran} in "
                f"{recording.ended.stamp:.3g} s. The period is 1 / rate, in seconds: {tenth:g} s gives "
                f"{1 / tenth:g} Hz."
            )
    return ""


def _times(runs: list[CallbackRun], callback: str) -> str:
    count = sum(run.callback == callback for run in runs)
    return "once" if count == 1 else f"{count} times"
