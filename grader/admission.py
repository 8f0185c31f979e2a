"""Is there anything to run? What a test cell may hand over by mistake, before a node is started."""

from __future__ import annotations

import reprlib
from collections.abc import Iterable, Sequence
from typing import Any

from grader.diagnosis.fault import NOT_STARTED, Fault
from sim import Process
from sim.notebook import find_outdated


def refusal(nodes: Sequence[Any]) -> Fault | None:
    """Why the first unusable one of these can't be run; None when all can."""
    if not nodes:
        return unusable("nothing", "Put the name of your class between the brackets: grade(MyNode).")
    try:
        return next((fault for node in nodes if (fault := _refuse(node) or _refuse_remappings(node))), None)
    except Exception as error:  # the student's own class may answer any question with an exception
        saw = f"something that raises {type(error).__name__} when it is looked at"
        return unusable(saw, "Give an ordinary class that is based on Node.")


def not_run(nodes: Sequence[Any]) -> Fault | None:
    """That the notebook shows a newer version of these than would be judged; None if it doesn't."""
    found = find_outdated(nodes)
    if found is None:
        return None
    return Fault(
        "the code that your notebook shows",
        found.saw,
        f"{found.hint} Nothing was judged: it would have been an older version.",
        before_start=True,
        sentence="Your last version did not run.",
    )


def _refuse(node: Any) -> Fault | None:
    target = node.target if isinstance(node, Process) else node
    if target is None:
        return unusable("None", "This exercise is not started yet: write your class in the cell above.")
    if isinstance(target, type):
        name = target.__name__
        if _is_node_class(target):
            return None
        return unusable(
            f"the class {name}, which is not a Node", f"Begin the class with `class {name}(Node):`."
        )
    if _is_node_class(type(target)):
        name = type(target).__name__
        hint = f"Leave out the brackets after the name: {name}, not {name}()."
        return unusable(f"an object of {name}", hint)
    if not callable(target):
        hint = "Give the class itself, by its name and without quotes."
        return unusable(f"{reprlib.repr(target)}, which is not a node", hint)
    return None


def _refuse_remappings(node: Any) -> Fault | None:
    remappings = node.remappings if isinstance(node, Process) else ()
    pairs = list(remappings) if isinstance(remappings, Iterable) else [remappings]
    if all(isinstance(pair, (tuple, list)) and [type(name) for name in pair] == [str, str] for pair in pairs):
        return None
    return unusable(
        f"remappings={reprlib.repr(remappings)}",
        'Remappings are a list of pairs of names: remappings=[("from", "to")].',
    )


def _is_node_class(cls: type) -> bool:
    """By name, because nothing here may need rclpy."""
    return any(base.__module__ == "rclpy.node" and base.__name__ == "Node" for base in cls.__mro__)


def unusable(saw: str, hint: str) -> Fault:
    """A fault for what is handed over in place of a program."""
    return Fault(
        "your node's class, or your main function", saw, hint, before_start=True, sentence=NOT_STARTED
    )
