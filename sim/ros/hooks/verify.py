"""Verifies that what the hooks replace is what they were written for."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from importlib.metadata import version
from inspect import Parameter
from platform import python_version
from types import FunctionType, ModuleType
from typing import Any

from sim.distro import RCLPY_DISTRIBUTION
from sim.ros.hooks.rclpy_internals import missing
from sim.ros.hooks.table import Hook

RCLPY_OF = {"jazzy": "7.1.6", "kilted": "9.1.2"}  # the version of each ROS distribution that a run supports
WRITTEN_FOR = {"rclpy": " and ".join(RCLPY_OF.values()), "numpy": "2.4.6", "Python": "3.11 to 3.14"}
_DISTRIBUTIONS = {"rclpy": RCLPY_DISTRIBUTION, "numpy": "numpy"}
_VARIADIC = (Parameter.VAR_POSITIONAL, Parameter.VAR_KEYWORD)


class HookError(ImportError):
    """A hook's target is different in the installed version."""


def check_internals() -> None:
    """Raise HookError unless rclpy has all that a run uses of it beside the hooks."""
    names = missing()
    if names:
        installed = version(_DISTRIBUTIONS["rclpy"])
        raise HookError(
            f"A run uses {', '.join(names)}, which rclpy {installed} does not have, or has with other "
            f"arguments: this course was written for rclpy {WRITTEN_FOR['rclpy']}."
        )


def original_of(hook: Hook) -> Any:
    """The attribute that the hook is to replace. Raises HookError if there is none."""
    try:
        return vars(hook.owner)[hook.name]
    except KeyError:
        raise _error(hook, "{found} does not have") from None


def check_arguments(hook: Hook, original: Any, replacement: Any) -> None:
    """Raise HookError unless the replacement takes the arguments of the original, in their order, by name.

    C code has no names to compare.
    """
    if not isinstance(original, FunctionType):
        return
    wanted, given = _parameters(original), _parameters(replacement)
    positions = [name for name, kind in wanted.items() if kind is Parameter.POSITIONAL_OR_KEYWORD]
    for place, (name, kind) in enumerate(given.items()):
        moved = kind is Parameter.POSITIONAL_OR_KEYWORD and positions[place : place + 1] != [name]
        if kind not in _VARIADIC and (name not in wanted or moved):
            raise _error(hook, f"in {{found}} has no argument {name!r} there")
    for name, kind in wanted.items():
        if name not in given and not _rest(kind) <= set(given.values()):
            raise _error(hook, f"in {{found}} has an argument {name!r} that its hook does not take")


def _parameters(function: Callable[..., Any]) -> dict[str, Any]:
    """The kinds of a function's parameters, by name."""
    return {name: found.kind for name, found in inspect.signature(function).parameters.items()}


def _rest(kind: Any) -> set[Any]:
    """The kinds of variadic parameters that take an argument of this kind."""
    return {
        Parameter.POSITIONAL_OR_KEYWORD: set(_VARIADIC),
        Parameter.KEYWORD_ONLY: {Parameter.VAR_KEYWORD},
    }.get(kind, set())


def _error(hook: Hook, what: str) -> HookError:
    owner = hook.owner
    name = owner.__name__ if isinstance(owner, ModuleType) else f"{owner.__module__}.{owner.__qualname__}"
    library = name.split(".")[0] if name.split(".")[0] in _DISTRIBUTIONS else "Python"
    installed = version(_DISTRIBUTIONS[library]) if library in _DISTRIBUTIONS else python_version()
    what = what.format(found=f"{library} {installed}")
    return HookError(
        f"A run reaches into {name}.{hook.name}, which {what}: this course was written for {library} "
        f"{WRITTEN_FOR[library]}."
    )
