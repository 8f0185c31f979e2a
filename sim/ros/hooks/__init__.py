"""Every place where a run reaches into rclpy or Python, in one table.

A hook replaces one attribute, once per process, when `sim` is imported. It asks first whether student code
of a run is calling; if not, it does just what the original does. So the hooks are inert outside a run, and
names that a student binds early (`from time import sleep`) go through them too.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from types import ModuleType
from typing import Any


@dataclass(frozen=True)
class Hook:
    """One replaced attribute: `make(original)` gives the replacement."""

    owner: Any
    name: str
    reason: str
    make: Callable[[Any], Any]


# Modules of Python that bound a clock by name, for their timeouts.
READS_CLOCKS = ("queue", "sched", "threading")

HOOKS: list[Hook] = []
_replaced: dict[int, tuple[Any, Any]] = {}  # id of an original function -> (it, its replacement)


def hook(owner: Any, name: str, reason: str) -> Callable[[Callable[[Any], Any]], Callable[[Any], Any]]:
    """Declare a hook. The decorated function gets the original and returns the replacement."""

    def declare(make: Callable[[Any], Any]) -> Callable[[Any], Any]:
        HOOKS.append(Hook(owner, name, reason, make))
        return make

    return declare


def install() -> None:
    """Install all hooks, once per process."""
    if _replaced:
        return
    from sim.ros.hooks import (  # noqa: F401  (each declares its hooks)
        actions,
        executors,
        graph,
        processes,
        ros_time,
        services,
        threads,
        time_and_chance,
    )

    for entry in HOOKS:
        original = entry.owner.__dict__[entry.name]
        plain = original.__func__ if isinstance(original, staticmethod) else original
        replacement = entry.make(plain)
        if isinstance(entry.owner, ModuleType):
            _replaced[id(plain)] = (plain, replacement)
        setattr(entry.owner, entry.name, staticmethod(replacement) if plain is not original else replacement)
    for module in list(sys.modules.values()):
        if module is None:  # forbidden to be imported
            continue
        if not _library(module) or module.__name__ in READS_CLOCKS:
            rebind(vars(module))


def rebind(names: dict[str, Any]) -> None:
    """Let names bound earlier (`from time import sleep` in a cell before) mean the hooks."""
    for name, value in list(names.items()):
        entry = _replaced.get(id(value))
        if entry is not None and entry[0] is value:
            names[name] = entry[1]


def _library(module: ModuleType) -> bool:
    file = getattr(module, "__file__", None)
    if module.__name__.startswith("sim."):
        return True
    if file is None:
        return module.__name__ != "__main__"
    return file.startswith((sys.base_prefix, sys.prefix)) or "site-packages" in file
