"""The classes and functions that a run was made from, while its recording exists in this process.

A recording is plain data and has no code. What explains a run to its author needs the code, too.
"""

from __future__ import annotations

import weakref
from collections.abc import Iterable
from typing import Any

from sim.evidence import Recording

_programs: dict[int, tuple[Any, ...]] = {}  # by the identity of the recording


def remember_programs(recording: Recording, programs: Iterable[Any]) -> None:
    """Store the user's programs of a run, without those of the course."""
    if id(recording) not in _programs:
        weakref.finalize(recording, _programs.pop, id(recording), None).atexit = False
    _programs[id(recording)] = tuple(programs)


def run_programs(recording: Recording) -> tuple[Any, ...]:
    """The user's programs of a run: node classes and functions.

    Empty for a recording that was loaded from a file, copied or made in another process.
    """
    return _programs.get(id(recording), ())
