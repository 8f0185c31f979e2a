"""Tests of launch files, as a plugin of pytest.

A function marked with `@pytest.mark.launch(fixture=...)` runs while the launch description of that fixture is
executed. The fixture is a function decorated with `@launch_pytest.fixture`.
"""

from __future__ import annotations

import importlib
from typing import Any

from launch_pytest.fixtures import fixture

__all__ = ["actions", "fixture", "tools"]


def __getattr__(name: str) -> Any:
    # Imported on first use, because they import launch, and pytest loads this plugin for any tests.
    if name in ("actions", "tools"):
        return importlib.import_module(f"{__name__}.{name}")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
