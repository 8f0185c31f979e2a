"""Imports messages without the code generators of the package that loads their type support."""

from __future__ import annotations

import importlib
import importlib.util
import sys
from types import ModuleType

PACKAGE, NAME = "rosidl_generator_py", "import_type_support"


def import_without_generators() -> None:
    """Let messages import `import_type_support` alone: its package imports parsers, for half a second.

    Where the package has another form, it is imported as usual.
    """
    spec = importlib.util.find_spec(PACKAGE)
    if PACKAGE in sys.modules or spec is None or not spec.submodule_search_locations:
        return
    package = ModuleType(PACKAGE)
    package.__path__ = list(spec.submodule_search_locations)
    sys.modules[PACKAGE] = package
    try:
        module = importlib.import_module(f"{PACKAGE}.{NAME}_impl")
        setattr(package, NAME, getattr(module, NAME))
    except (AttributeError, ImportError):
        del sys.modules[PACKAGE]
