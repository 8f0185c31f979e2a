"""The table of all hooks.

A hook replaces one attribute, once per process, when `sim` is imported. It checks first whether student code
of a run is calling; if not, it does exactly what the original does. So the hooks are inert outside a run, and
names that a student binds early (`from time import sleep`) are hooked, too.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Hook:
    """One replaced attribute: `make(original)` returns the replacement."""

    owner: Any
    name: str
    reason: str
    make: Callable[[Any], Any]


HOOKS: list[Hook] = []


def hook(owner: Any, name: str, reason: str) -> Callable[[Callable[[Any], Any]], Callable[[Any], Any]]:
    """Declare a hook. The decorated function takes the original and returns the replacement."""

    def declare(make: Callable[[Any], Any]) -> Callable[[Any], Any]:
        HOOKS.append(Hook(owner, name, reason, make))
        return make

    return declare
