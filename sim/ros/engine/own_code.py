"""The functions of the programs in a run: those of their modules and cells, and of what these import."""

from __future__ import annotations

import gc
import importlib.machinery
import sys
from collections.abc import Iterator, Sequence
from functools import partial
from inspect import getattr_static
from types import FunctionType, MethodType, ModuleType
from typing import Any

from sim.ros.engine.points import source_of
from sim.ros.recorder.tracebacks import is_library, is_of_course

COURSE = ("sim", "grader")
EXTENSIONS = tuple(importlib.machinery.EXTENSION_SUFFIXES)


class OwnCode:
    """The code and objects of these programs before a run starts.

    functions: all that exist, in classes, in other functions and behind decorators, too. compiled: the names
    of modules that are not in Python.
    """

    def __init__(self, targets: Sequence[Any]) -> None:
        self.compiled: list[str] = []
        self._packages: set[str] = set()  # of the targets: these may be installed, as libraries are
        self._namespaces: dict[int, dict[str, Any]] = {}
        for target in targets:
            space = _namespace(_unwrapped(target))
            if space is not None and not is_of_course(_text(space, "__file__")):
                self._packages.add(_package(space))
                self._add(space)
        found = gc.get_referrers(*self._namespaces.values()) if self._namespaces else []
        self.functions = [
            each for each in found if _is_function(each) and id(each.__globals__) in self._namespaces
        ]

    def _add(self, space: dict[str, Any]) -> None:
        """Add global names, and those of the modules, functions and classes that are among them."""
        if id(space) in self._namespaces:
            return
        self._namespaces[id(space)] = space
        found = [_namespace(value) for value in list(space.values())]
        for other in [*found, *map(vars, _imported(space))]:
            if other is not None and id(other) not in self._namespaces and self._is_own(other):
                if _text(other, "__file__").endswith(EXTENSIONS):
                    self.compiled.append(_text(other, "__name__"))
                else:
                    self._add(other)

    def _is_own(self, space: dict[str, Any]) -> bool:
        if _package(space) in self._packages:
            return True
        file = _text(space, "__file__")
        return bool(file) and not is_library(file) and _package(space) not in COURSE


def new_functions() -> list[FunctionType]:
    """The functions of the programs that were created since the run started."""
    return [
        found
        for found in gc.get_objects()
        if _is_function(found) and not is_library(found.__code__.co_filename)
    ]


def _is_function(found: Any) -> bool:
    """Return whether code can call it. Python makes one of a module or a cell while that runs."""
    return type(found) is FunctionType and found.__code__.co_name != "<module>"


def _unwrapped(target: Any) -> Any:
    while type(target) in (partial, MethodType):
        target = target.func if type(target) is partial else target.__func__
    return target if type(target) is FunctionType or issubclass(type(target), type) else type(target)


def _namespace(found: Any) -> dict[str, Any] | None:
    """The global names of a module, or those that a function or a class sees.

    Objects of other types are not asked for anything: they may be a student's.
    """
    if type(found) is FunctionType:
        return found.__globals__
    if type(found) is not ModuleType and issubclass(type(found), type):
        name = getattr_static(found, "__module__", None)
        found = sys.modules.get(name) if isinstance(name, str) else None
    return vars(found) if type(found) is ModuleType else None


def _text(space: dict[str, Any], name: str) -> str:
    found = space.get(name)
    return found if isinstance(found, str) else ""


def _package(space: dict[str, Any]) -> str:
    return _text(space, "__name__").partition(".")[0]


def _imported(space: dict[str, Any]) -> Iterator[ModuleType]:
    """The modules that the files of these names import, also inside functions."""
    classes = [value for value in list(space.values()) if issubclass(type(value), type)]
    values = [*space.values(), *(part for each in classes for part in vars(each).values())]
    codes = {each.__code__.co_filename: each.__code__ for each in values if type(each) is FunctionType}
    for code in codes.values():
        for name, level in source_of(code).imports if not is_library(code.co_filename) else ():
            above = _text(space, "__package__").rsplit(".", level - 1)[0] if level else ""
            module = sys.modules.get(f"{above}.{name}".strip("."))
            if type(module) is ModuleType:
                yield module
