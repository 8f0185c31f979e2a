"""Validates the arguments of `grade` before a node is started."""

from __future__ import annotations

import reprlib
from collections.abc import Iterable, Sequence
from typing import Any

from grader.diagnosis.fault import NOT_STARTED, Fault
from sim import Process
from sim.notebook import find_outdated


def refusal(nodes: Sequence[Any]) -> Fault | None:
    """Return why the first invalid argument can't be run; None if all are valid."""
    if not nodes:
        return unusable_argument(
            "nothing", "Put the name of your class between the parentheses: grade(MyNode)."
        )
    try:
        return next((fault for node in nodes if (fault := _refuse(node) or _refuse_remappings(node))), None)
    except Exception as error:  # a student's metaclass may raise in any operation
        saw = f"something that raises {type(error).__name__} when it is inspected"
        return unusable_argument(saw, "Give an ordinary class that is based on Node.")


def outdated_code(nodes: Sequence[Any]) -> Fault | None:
    """The fault for code that is older than the code in the notebook; None if it is current.

    nodes: programs, and paths of the folders that are graded.
    """
    found = find_outdated(nodes)
    if found is None:
        return None
    return Fault(
        "the code that your notebook shows",
        found.saw,
        f"{found.hint} Nothing was graded: it would have been an older version.",
        before_start=True,
        sentence="Your last version did not run.",
    )


def _refuse(node: Any) -> Fault | None:
    target = node.target if isinstance(node, Process) else node
    if target is None:
        hint = "This exercise is not started yet: write your class in the cell above."
        return unusable_argument("None", hint)
    if isinstance(target, type):
        name = target.__name__
        if _is_node_class(target):
            return None
        return unusable_argument(
            f"the class {name}, which is not a Node", f"Begin the class with `class {name}(Node):`."
        )
    if _is_node_class(type(target)):
        name = type(target).__name__
        hint = f"Leave out the parentheses after the name: {name}, not {name}()."
        return unusable_argument(f"an object of {name}", hint)
    if not callable(target):
        hint = "Give the class itself, by its name and without quotes."
        return unusable_argument(f"{reprlib.repr(target)}, which is not a node", hint)
    return None


def _refuse_remappings(node: Any) -> Fault | None:
    remappings = node.remappings if isinstance(node, Process) else ()
    pairs = list(remappings) if isinstance(remappings, Iterable) else [remappings]
    if all(isinstance(pair, (tuple, list)) and [type(name) for name in pair] == [str, str] for pair in pairs):
        return None
    return unusable_argument(
        f"remappings={reprlib.repr(remappings)}",
        'Remappings are a list of pairs of names: remappings=[("from", "to")].',
    )


def _is_node_class(cls: type) -> bool:
    """By name, because this module must not import rclpy."""
    return any(base.__module__ == "rclpy.node" and base.__name__ == "Node" for base in cls.__mro__)


def unusable_argument(saw: str, hint: str) -> Fault:
    """The fault for an argument that is not a program."""
    return Fault(
        "your node's class, or your main function", saw, hint, before_start=True, sentence=NOT_STARTED
    )
