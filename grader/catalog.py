"""The catalog of all exercises in grader.exercises, by name."""

from __future__ import annotations

import functools
import importlib
import pkgutil
from typing import Any

from grader.exercise import Exercise
from grader.score import Score
from sim.suggestions import unknown_name


@functools.cache
def exercises() -> dict[str, Exercise]:
    """All exercises by name, sorted. Raises ValueError for a duplicate name."""
    import grader.exercises as package

    found: dict[str, Exercise] = {}
    for info in pkgutil.iter_modules(package.__path__, package.__name__ + "."):
        for item in vars(importlib.import_module(info.name)).values():
            if isinstance(item, Exercise) and found.setdefault(item.name, item) is not item:
                raise ValueError(
                    f"two exercises are called {item.name!r}: names must be unique in the course"
                )
    return dict(sorted(found.items()))


def grade(exercise: Exercise | str, *nodes: Any) -> Score:
    """The score of a student's nodes in an exercise, given as an object or by name.

    Raises LookupError for an unknown name.
    """
    return (exercise if isinstance(exercise, Exercise) else find(exercise)).grade(*nodes)


def find(name: str) -> Exercise:
    """The exercise with this name. Raises LookupError for an unknown name."""
    known = exercises()
    if name not in known:
        raise LookupError(unknown_name("exercise", name, known))
    return known[name]
