"""The time within which a response counts: the only place with a rule for its edges."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple, Protocol, TypeVar

from sim.evidence import Seconds

EDGE: Seconds = 1e-6
"""Stamps are sums of floating-point numbers: one that is this close to an edge is inside."""


class Stamped(Protocol):
    """A row of a recording: a message, a log line, a pose."""

    @property
    def stamp(self) -> Seconds:
        """Simulated seconds since the start of the run."""


Row = TypeVar("Row", bound=Stamped)


class Window(NamedTuple):
    """A span of simulated time. Both edges belong to it."""

    begin: Seconds
    end: Seconds

    @classmethod
    def after(cls, stamp: Seconds, within: Seconds) -> Window:
        """Return the window that begins at a stamp and lasts for `within` seconds."""
        return cls(stamp, stamp + within)

    def contains(self, stamp: Seconds) -> bool:
        """Return whether a stamp is inside."""
        return self.begin - EDGE <= stamp <= self.end + EDGE

    def rows(self, rows: Iterable[Row]) -> list[Row]:
        """Return the rows whose stamp is inside, in their order."""
        return [row for row in rows if self.contains(row.stamp)]
