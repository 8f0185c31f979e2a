"""The programs of a student's answers: one that publishes them, and the repaired systems."""

from __future__ import annotations

import functools
import inspect
import json
import textwrap
from collections.abc import Callable, Mapping
from typing import Any

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Int32, String

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
LIBRARIES = ("rclpy", "builtins", "grader")


class Auditor(Node):
    """Publishes the answers on /audit/answers, with the number that arrives on /audit/question."""

    def __init__(self, answers: Mapping[str, Any]) -> None:
        super().__init__("auditor")
        self.answers = answers
        self.publisher = self.create_publisher(String, "/audit/answers", LATCHED)
        self.create_subscription(Int32, "/audit/question", self.on_question, LATCHED)

    def on_question(self, msg: Int32) -> None:
        """Publish them."""
        text = json.dumps({"question": msg.data, "answers": self.answers}, default=str)
        self.publisher.publish(String(data=text))


def audited(answers: Callable[[], Mapping[str, Any]]) -> list[Any]:
    """Return the programs that `grade` and `run` take for answers.

    answers: a function that returns, for the name of each system, None if it is right in every order, or the
    delays that break it and the repaired class.
    """
    try:
        found = answers()
    except Exception:
        return [answers]  # it fails in the run, which reports the line
    found = found if isinstance(found, Mapping) else {}
    pairs = [value for value in found.values() if _is_pair(value)]
    data = {str(name): _serialized(value) for name, value in found.items()}
    return [functools.partial(Auditor, data), *(class_ for _, class_ in pairs)]


def _is_pair(value: Any) -> bool:
    return isinstance(value, tuple) and len(value) == 2 and isinstance(value[1], type)


def _serialized(value: Any) -> dict[str, Any] | None:
    """Return an answer as data."""
    if value is None:
        return None
    if not _is_pair(value):
        return {"problem": str(value)[:60]}
    delays, class_ = value
    own = [each for each in class_.__mro__ if each.__module__.split(".")[0] not in LIBRARIES]
    inherits = any(each.__module__.startswith("grader.") for each in class_.__mro__)
    methods = {
        name: _source(part) for each in reversed(own) for name, part in vars(each).items()
        if inspect.isfunction(part) or (hasattr(part, "__get__") and not name.startswith("__"))
    }  # fmt: skip
    return {"delays": delays, "inherits": inherits, "methods": methods}


def _source(function: Any) -> str:
    """Return the source of a function; "" if it can't be read."""
    try:
        return textwrap.dedent(inspect.getsource(function))
    except (OSError, TypeError):
        return ""
