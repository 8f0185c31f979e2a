"""Lets fields for lists of numbers take what ROS takes: whole numbers for floats, and numpy arrays.

With ROS_PYTHON_CHECK_FIELDS rosidl's setters refuse these, although they convert them: a list of whole
numbers becomes `array.array('d', [0, 1])`. A single 1 for 1.0 is refused all the same: ROS sends nonsense for
it.
"""

from __future__ import annotations

import contextlib
import re
import sys
from collections.abc import Sequence
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder
from types import ModuleType
from typing import Any

import numpy as np

_INTERFACES = re.compile(r"\w+\.(msg|srv|action)\._\w+")
_NUMBERS = re.compile(r"sequence<(float|double|u?int\d+)>|(?:float|double|u?int\d+)\[(\d+)\]")


def install() -> None:
    """Do it for all message modules: those that are loaded, and those that will be. Idempotent."""
    if any(isinstance(finder, _Finder) for finder in sys.meta_path):
        return
    sys.meta_path.insert(0, _Finder())
    for name, module in list(sys.modules.items()):
        if _INTERFACES.fullmatch(name):
            _prepare(module)


class _Finder(MetaPathFinder):
    """Finds message modules as Python does, and prepares each after it was loaded."""

    def find_spec(self, name: str, path: Sequence[str] | None, target: Any = None) -> ModuleSpec | None:
        """Work like `MetaPathFinder`."""
        spec = PathFinder.find_spec(name, path, target) if _INTERFACES.fullmatch(name) else None
        if spec is None or spec.loader is None:
            return None
        execute = spec.loader.exec_module

        def exec_module(module: ModuleType) -> None:
            execute(module)
            _prepare(module)

        spec.loader.exec_module = exec_module
        return spec


def _prepare(module: ModuleType) -> None:
    for item in list(vars(module).values()):
        if isinstance(item, type) and item.__module__ == module.__name__:
            for name, kind in vars(item).get("_fields_and_field_types", {}).items():
                found, strict = _NUMBERS.fullmatch(kind), vars(item).get(name)
                if found and isinstance(strict, property):
                    setattr(item, name, _converting(strict, int(found[2]) if found[2] else None))


def _converting(strict: property, length: int | None) -> property:
    def put(message: Any, value: Any) -> None:
        try:
            strict.fset(message, value)
        except AssertionError:
            if length not in (None, np.size(value)) or not _put_unchecked(strict, message, value):
                raise

    return property(strict.fget, put, doc=strict.__doc__)


def _put_unchecked(strict: property, message: Any, value: Any) -> bool:
    """Set the field as without ROS_PYTHON_CHECK_FIELDS; whether the value could be converted."""
    message._check_fields = False
    try:
        with contextlib.suppress(TypeError, ValueError, OverflowError):
            strict.fset(message, value)
            return True
        return False
    finally:
        message._check_fields = True
