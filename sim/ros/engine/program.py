"""What a student runs: one program, with the settings that a launch file would give it."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from rclpy.node import Node


@dataclass(frozen=True)
class Process:
    """One program to run, with the settings a launch file would give it. The names are launch_ros's.

    target: a Node class, a callable that returns a Node or a Process, a main() function, or a launch file.
    remappings: pairs (from, to). parameters: name to value, or a list of such, as in a launch file.
    arguments: further command-line words, which the program finds in `sys.argv`; those after `--ros-args` are
    ROS's; a launch file takes NAME:=VALUE. stdin: the lines that `input()` returns, one after the other.
    lenient: messages take 1 for 1.0, and 2.0 for 2, and Float32 passes for Float64 where a topic has that,
    and the other way round; others find a parameter by nearly its name, and one whose default is 0 takes 0.5;
    a parameter whose default is 1.0 may start with 1 or "1.0". On a robot they don't.
    host: the computer that it runs on, where the run has a network; None for "laptop". The robot is "robot".
    """

    target: Callable[..., Any] | str
    name: str | None = None
    namespace: str | None = None
    remappings: Sequence[tuple[str, str]] = ()
    parameters: Mapping[str, Any] | Sequence[Mapping[str, Any]] = field(default_factory=dict)
    arguments: Sequence[str] = ()
    stdin: Sequence[str] | None = None
    lenient: bool = False
    host: str | None = None

    def command_line(self) -> list[str]:
        """The equivalent command-line arguments."""
        rules = [("__node", self.name)] if self.name else []
        if self.namespace:  # launch_ros, too, takes one without a slash
            rules.append(("__ns", f"{'' if str(self.namespace).startswith('/') else '/'}{self.namespace}"))
        words = [word for left, right in (*rules, *self.remappings) for word in ("-r", f"{left}:={right}")]
        for group in [self.parameters] if isinstance(self.parameters, Mapping) else self.parameters:
            for name, value in group.items():
                # rcl reads YAML, of which JSON is a part
                words += ["-p", f"{name}:={json.dumps(value, ensure_ascii=False, default=_as_list)}"]
        return [*self.arguments, *(["--ros-args", *words] if words else [])]


def _as_list(value: Any) -> Any:
    return value.tolist() if hasattr(value, "tolist") else list(value)  # of numpy, or such as a range


def as_process(target: Any, caller: str = "run") -> Process:
    """Accept what `run` and `play` accept. Raises TypeError with a sentence for the student."""
    process = target if isinstance(target, Process) else Process(target)
    inner = process.target
    if isinstance(inner, Node):
        name = type(inner).__name__
        raise TypeError(
            f"{caller}() takes the class, not an object of it: "
            f"write {caller}({name}), not {caller}({name}())."
        )
    if isinstance(inner, type) and not issubclass(inner, Node):
        raise TypeError(f"{inner.__name__} is not a ROS node: write `class {inner.__name__}(Node):`.")
    if isinstance(inner, str) and inner.isidentifier():
        raise TypeError(f"{caller}() takes the class itself: write {caller}({inner}), without quotes.")
    if isinstance(inner, list | tuple):
        raise TypeError(f"{caller}() takes programs one by one: write {caller}(A, B), without a list.")
    if not callable(inner):
        raise TypeError(
            f"{caller}() takes Node classes, functions that return a node, or main() functions;"
            f" this is {inner!r}."
        )
    return process


def program_name(target: Any) -> str:
    """Return what a class or function is called, however a student's class answers that question."""
    try:
        return str(getattr(target, "__name__", None) or type(target).__name__)
    except Exception:
        return "program"
