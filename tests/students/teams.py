"""Several programs that a student hands in together, as one entry of a module of students' nodes."""

from __future__ import annotations

from typing import Any


class Team:
    """Programs that `grade` is given one beside the other."""

    def __init__(self, *programs: Any) -> None:
        self.programs = programs


def programs_of(entry: Any) -> tuple[Any, ...]:
    """What `grade` is given for an entry: a team's programs, or the program that it is."""
    return entry.programs if isinstance(entry, Team) else (entry,)
