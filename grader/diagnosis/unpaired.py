"""A message that is combined with one of another instant, although its counterpart exists."""

from __future__ import annotations

import ast
import bisect
from typing import NamedTuple

from grader.diagnosis.student_nodes import StudentNode, student_nodes
from sim.evidence import CallbackRun, Endpoint, Message, Recording, Seconds, since_start
from sim.notebook.attribute_analysis import own_attribute
from sim.ros.messages.codec import message_class

PAIRED = 0.8  # of the messages on a topic have a counterpart with the same stamp: the two belong together
EXACT = 1e-6  # s: stamps that differ by less are the same


class Mismatch(NamedTuple):
    """A message, and the one that it was combined with: their stamps in seconds since the start."""

    stamp: Seconds
    other: Seconds


def other_instant(recording: Recording) -> str:
    """A callback that combines its message with the last one of another topic, which has another stamp.

    Using the last odometry or map in a callback for scans is common and right. So this is reported only if
    all of this is true: both types have a header; at least four of five messages of the callback's topic
    have a counterpart on the other topic with exactly the same stamp, so the two belong together; in this run
    the stored message had another stamp; the code combines both in one calculation or one call; and neither
    callback looks at a stamp or a header.
    """
    for node in student_nodes(recording):
        for user in node.registered:
            for name, setter in _stored(node, user):
                stored, own = node.subscription(setter), node.subscription(user)
                if stored and own and stored.name != own.name:
                    mismatch = _mismatch(recording, node, (setter, user), (stored, own))
                    if mismatch:
                        return _other_instant(user, name, (stored, own), mismatch)
    return ""


def _other_instant(user: str, name: str, ends: tuple[Endpoint, ...], found: Mismatch) -> str:
    stored, own = (end.name for end in ends)
    return (
        f"{user} combines its message of {own} with self.{name}, the last one of {stored}, as if both "
        f"belonged to the same instant: it combined {own} of {found.stamp:.3g} s with {stored} of "
        f"{found.other:.3g} s, although there is one of {found.stamp:.3g} s. Pair them by stamp: "
        "subscribe with message_filters.Subscriber, and register the callback with "
        "message_filters.TimeSynchronizer([a, b], 10)."
    )


def _stored(node: StudentNode, user: str) -> list[tuple[str, str]]:
    """Attributes in which another subscription alone stores its message, and which a callback combines."""
    use = node.uses.get(user)
    if use is None or _compares_stamps(node, user):
        return []
    found = []
    for name in sorted(use.reads - use.writes):
        writers = node.writers(name)
        if len(writers) == 1 and writers[0] in node.registered and not _compares_stamps(node, writers[0]):
            method = node.methods[user.split(".")[-1]]
            if _keeps_message(node, writers[0], name) and _combines(method, name):
                found.append((name, writers[0]))
    return found


def _compares_stamps(node: StudentNode, callback: str) -> bool:
    return any(
        isinstance(part, ast.Attribute) and part.attr in ("stamp", "header")
        for method in node.parts(callback)
        for part in ast.walk(method)
    )


def _keeps_message(node: StudentNode, setter: str, name: str) -> bool:
    """Return whether a callback stores its message, or something out of it, in the attribute."""
    method = node.methods[setter.split(".")[-1]]
    message = _message(method)
    return any(
        isinstance(part, ast.Assign)
        and own_attribute(part.targets[0]) == name
        and message in {leaf.id for leaf in ast.walk(part.value) if isinstance(leaf, ast.Name)}
        for part in ast.walk(method)
    )


def _message(method: ast.FunctionDef | ast.AsyncFunctionDef) -> str:
    return method.args.args[1].arg if len(method.args.args) > 1 else ""


def _combines(method: ast.FunctionDef | ast.AsyncFunctionDef, name: str) -> bool:
    """Return whether a calculation or a call has both the attribute and the callback's own message in it."""
    message = _message(method)
    for part in ast.walk(method):
        operands = [part.left, part.right] if isinstance(part, ast.BinOp) else []
        if isinstance(part, ast.Call):
            operands = [*part.args, *(keyword.value for keyword in part.keywords)]
        leaves = [leaf for operand in operands for leaf in ast.walk(operand)]
        names = {leaf.id for leaf in leaves if isinstance(leaf, ast.Name)}
        if message in names and any(own_attribute(leaf) == name for leaf in leaves):
            return True
    return False


def _mismatch(
    recording: Recording, node: StudentNode, callbacks: tuple[str, str], ends: tuple[Endpoint, ...]
) -> Mismatch | None:
    """The first execution that combined two messages of different stamps of which a pair exists."""
    if recording.network is not None or any(
        run.duration > EXACT for runs in node.runs.values() for run in runs
    ):
        return None  # which message a callback was called with is not certain
    if any("header" not in message_class(end.type).get_fields_and_field_types() for end in ends):
        return None
    stored, own = (recording.messages(end.name) for end in ends)
    stamps = sorted(_stamp(message) for message in stored)
    paired = [_has(stamps, _stamp(message)) for message in own]
    if not paired or sum(paired) < PAIRED * len(paired):
        return None
    setter, user = callbacks
    last: CallbackRun | None = None
    for run in (run for run in recording.callbacks if run.node == node.name):
        last = run if run.callback == setter else last
        if run.callback == user and last is not None:
            mine, other = _latest(own, run.stamp), _latest(stored, last.stamp)
            if mine and other and _has(stamps, _stamp(mine)) and _differ(mine, other):
                return Mismatch(_stamp(mine), _stamp(other))
    return None


def _latest(messages: list[Message], stamp: Seconds) -> Message | None:
    """The last message that was published by then."""
    index = bisect.bisect_right(messages, stamp + EXACT, key=lambda message: message.stamp)
    return messages[index - 1] if index else None


def _stamp(message: Message) -> Seconds:
    return since_start(message.message.header.stamp)


def _has(stamps: list[Seconds], stamp: Seconds) -> bool:
    index = bisect.bisect_left(stamps, stamp - EXACT)
    return index < len(stamps) and stamps[index] <= stamp + EXACT


def _differ(one: Message, other: Message) -> bool:
    return abs(_stamp(one) - _stamp(other)) > EXACT
