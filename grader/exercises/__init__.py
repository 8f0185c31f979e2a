"""The exercises of the course: a package for each assignment, and in it a module or a package for each."""

import importlib
import pkgutil
import sys
from typing import Any


def notebook_names(package: str) -> dict[str, Any]:
    """Return what the exercises of an assignment give to its notebook, by name.

    package: the assignment's, such as "grader.exercises.topics". An exercise gives what its module lists in
    `__all__`; without that list itself alone, which has the name of the module.
    """
    found: dict[str, Any] = {}
    for info in pkgutil.iter_modules(sys.modules[package].__path__):
        module = importlib.import_module(f"{package}.{info.name}")
        found |= {name: getattr(module, name) for name in getattr(module, "__all__", [info.name])}
    return found
