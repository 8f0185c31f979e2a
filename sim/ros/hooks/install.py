"""Installs the hooks."""

from __future__ import annotations

import sys
from types import ModuleType
from typing import Any

from sim.ros.hooks import (  # noqa: F401  (each declares its hooks)
    actions,
    children,
    event_loops,
    executors,
    graph,
    graph_queries,
    namesakes,
    node_in_cell,
    parameters,
    processes,
    ros_time,
    services,
    threads,
    time_and_random,
    wall_clock_spin,
)
from sim.ros.hooks.table import HOOKS, Hook
from sim.ros.hooks.verify import check_arguments, check_internals, original_of
from sim.ros.messages import number_lists

# Modules of Python that bound a clock by name, for their timeouts.
READS_CLOCKS = ("queue", "sched", "threading")

_replaced: dict[int, tuple[Any, Any]] = {}  # id of an original function -> (it, its replacement)


def install() -> None:
    """Install all hooks, once per process; raise HookError, and install none, if one doesn't fit."""
    if _replaced:
        return
    check_internals()
    number_lists.install()
    for hook, original, replacement in [(hook, *_replacement(hook)) for hook in HOOKS]:
        if isinstance(hook.owner, ModuleType):
            _replaced[id(original)] = (original, replacement)
        static = isinstance(vars(hook.owner)[hook.name], staticmethod)
        setattr(hook.owner, hook.name, staticmethod(replacement) if static else replacement)
    for module in list(sys.modules.values()):
        if module is None:  # forbidden to be imported
            continue
        if not _library(module) or module.__name__ in READS_CLOCKS:
            rebind(vars(module))


def _replacement(hook: Hook) -> tuple[Any, Any]:
    """Return what a hook replaces, and its replacement. Raises HookError."""
    original = original_of(hook)
    original = original.__func__ if isinstance(original, staticmethod) else original
    replacement = hook.make(original)
    check_arguments(hook, original, replacement)
    return original, replacement


def rebind(names: dict[str, Any]) -> None:
    """Replace names bound earlier (`from time import sleep` in a previous cell) by the hooks."""
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
