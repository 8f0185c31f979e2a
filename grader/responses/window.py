"""The time within which a response counts: the only place with a rule for its edges."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple, Protocol, TypeVar

from sim.evidence import Recording, Seconds

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

    def before(self, stamp: Seconds) -> Window:
        """Return the part of it before a stamp, such as that of the next stimulus, which is outside."""
        return Window(self.begin, min(self.end, stamp - 2 * EDGE))

    def is_over(self, run: Recording) -> bool:
        """Return whether a run lasts longer: then what should come within it had its time."""
        return self.end + EDGE < run.ended.stamp

    def contains(self, stamp: Seconds) -> bool:
        """Return whether a stamp is inside."""
        return self.begin - EDGE <= stamp <= self.end + EDGE

    def rows(self, rows: Iterable[Row]) -> list[Row]:
        """Return the rows whose stamp is inside, in their order."""
        return [row for row in rows if self.contains(row.stamp)]
