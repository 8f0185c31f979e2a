"""Process starters for new launch contexts, other than the operating system's.

This module is outside `launch`, because a program that provides process starters needs it before any launch
file is executed, and `launch` takes long to import.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

# Each returns a `launch.processes.ProcessStarter`, or None where it does not apply; the first one is used.
providers: list[Callable[[], Any]] = []


def provided_starter() -> Any:
    """The process starter that a new launch context gets; None for the operating system's."""
    return next((starter for provide in providers if (starter := provide()) is not None), None)
