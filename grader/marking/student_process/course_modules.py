"""What of the course a student's process can import: what the released notebooks import, and no more.

Right functions and reference data are in the modules of exercises and companions, and stay with the judge.
"""

from __future__ import annotations

import contextlib
import dataclasses
import functools
import gc
import sys
from collections.abc import Iterable, Iterator, Sequence
from importlib.abc import MetaPathFinder
from types import ModuleType
from typing import Any, NoReturn

from grader.catalog import exercises
from grader.marking.student_process.judge_only import CLOSED, EXERCISES

# The judge names functions of these, which prepare a program.
SERVED = (
    "grader.companions.main_observer",
    "grader.companions.parameter_start",
    "grader.companions.race_test_runner",
    "grader.companions.test_runner",
)


def keep_only(packages: Sequence[str]) -> None:
    """Remove all modules with answers from this process, but for these packages of exercises.

    packages: full names, such as "grader.exercises.topics". They keep the names that notebooks use. Exercises
    keep their names and no check: what is graded is handed over to the judge.
    """
    kept = {name: sys.modules[name] for name in packages if name in sys.modules}
    _empty_exercises()
    for module in kept.values():
        _replace_companions(module)
    closed = {name: module for name, module in sys.modules.items() if _is_closed(name) and name not in kept}
    needed = {module.__name__ for module in _needed_by(kept.values(), closed)}
    for name in closed:
        del sys.modules[name]
        parent, _, last = name.rpartition(".")
        if getattr(sys.modules.get(parent), last, None) is closed[name]:
            delattr(sys.modules[parent], last)
    for name, module in closed.items():
        if name not in needed:
            _clear(module)
    sys.meta_path.insert(0, ClosedModules(packages))
    gc.collect()


def _clear(module: ModuleType) -> None:
    """Remove all that a module defines, and all methods of its classes.

    Python lists the subclasses of every class, and memory that is shared with the judge is not collected.
    """
    classes = [value for value in vars(module).values() if isinstance(value, type)]
    for owner in (each for each in classes if each.__module__ == module.__name__):
        for name, part in list(vars(owner).items()):
            if callable(part) or isinstance(part, property | classmethod | staticmethod):
                with contextlib.suppress(AttributeError, TypeError):
                    delattr(owner, name)
    vars(module).clear()


class ClosedModules(MetaPathFinder):
    """Says of a module that stays with the judge that it is not here."""

    def __init__(self, packages: Sequence[str]) -> None:
        self._packages = packages

    def find_spec(self, fullname: str, path: Any, target: Any = None) -> None:
        """Raise ModuleNotFoundError for such a module."""
        if _is_closed(fullname):
            self._refuse(fullname)

    def _refuse(self, name: str) -> NoReturn:
        there = " and ".join(["grader", *self._packages])
        text = (
            f"No module named {name!r} when a class is marked: from the grader, notebooks can import {there}"
        )
        raise ModuleNotFoundError(text, name=name)


def _is_closed(name: str) -> bool:
    below = name.startswith(tuple(f"{closed}." for closed in (EXERCISES, *CLOSED)))
    return (below or name in CLOSED) and name not in SERVED


def _empty_exercises() -> None:
    """Take checks, runs and right definitions of all exercises away; `see` needs the runs of packages."""
    for exercise in exercises().values():
        exercise.checks.clear()
        if not exercise.package:
            exercise.scenarios, exercise.companions, exercise.world, exercise.until = (), (), None, None
        if exercise.uses:
            exercise.uses = dataclasses.replace(exercise.uses, definitions={})


def _replace_companions(package: ModuleType) -> None:
    """Leave out those whose nodes hold right functions, or answers: their module says `WITH_JUDGE = True`."""
    for name, value in list(vars(package).items()):
        home = sys.modules.get(getattr(value, "__module__", ""))
        if getattr(home, "WITH_JUDGE", False):
            setattr(package, name, no_companions)


def no_companions(seed: int) -> list[Any]:
    """No program: those of this name run with the judge only."""
    return []


def _needed_by(packages: Iterable[ModuleType], closed: dict[str, ModuleType]) -> list[ModuleType]:
    """The modules whose functions and classes the packages name, and those that these modules name."""
    found: list[ModuleType] = []
    left = [module for package in packages for module in _named_in(package, closed)]
    while left:
        module = left.pop()
        if module not in found:
            found.append(module)
            left += _named_in(module, closed)
    return found


def _named_in(module: ModuleType, closed: dict[str, ModuleType]) -> Iterator[ModuleType]:
    for value in vars(module).values():
        for each in _parts(value):
            name = each.__name__ if isinstance(each, ModuleType) else getattr(each, "__module__", None)
            if isinstance(name, str) and name in closed and not _is_exercise(name):
                yield closed[name]


def _is_exercise(name: str) -> bool:
    """Return whether a module has an exercise and its checks: those of its companions are one level below."""
    return name.startswith(f"{EXERCISES}.") and name.count(".") == EXERCISES.count(".") + 2


def _parts(value: Any) -> list[Any]:
    """Return what is in a container, the function of a partial one, or the value itself."""
    if isinstance(value, functools.partial):
        return [value.func]
    if isinstance(value, dict):
        return list(value.values())
    return list(value) if isinstance(value, list | tuple) else [value]
