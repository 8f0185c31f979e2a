"""What `explore` has found: in which order nodes fail, what was different there, and what failed."""

from __future__ import annotations

import linecache
import re
from dataclasses import dataclass

from sim.evidence import CallbackError, Departure, Recording
from sim.order import ANY, NETWORK

NO_PROMISE = "Nothing guarantees the usual order, although the current rclpy always uses it."
_FRAME = re.compile(r'^  File "(?P<file>.+)", line (?P<line>\d+)', re.M)


@dataclass
class Explored:
    """What `explore` has found.

    failed: the order in which it does not hold, for `run(..., order=found.failed)`; None if it held in all.
    number: that order's number before it was shrunk. tried: the orders that were tried. usual: the run in
    the usual order. recording: the run in the failed order; None if there is none. interrupted: the user
    stopped the search.
    """

    usual: Recording
    failed: str | int | None = None
    number: int = 0
    tried: int = 0
    recording: Recording | None = None
    interrupted: bool = False
    level: str = NETWORK

    @property
    def departures(self) -> list[Departure]:
        """The choices of the failed order that differ from the usual one."""
        return [] if self.recording is None else list(self.recording.departures)

    @property
    def explanation(self) -> str:
        """What was found, in a sentence or two."""
        if self.recording is None:
            stopped = " The search was interrupted." if self.interrupted else ""
            return f"It holds in the usual order and in {self.tried} others.{stopped}"
        failure = failure_of(self.recording)
        if not self.departures:
            return f"It does not hold in the usual order. {failure}".rstrip()
        where = f"In order {self.number}, {list_departures(self.departures)}. {failure}".rstrip()
        promise = f" {NO_PROMISE}" if self.level == ANY else ""
        return f"{where}{promise} Run it again with run(..., order={self.failed!r})."

    def __repr__(self) -> str:
        return self.explanation

    def _repr_html_(self) -> str:
        from sim.view.order_comparison import comparison  # imported here because it is slow

        return comparison(self.explanation, self.usual, self.recording)


def list_departures(departures: list[Departure]) -> str:
    """What came in another order, for the middle of a sentence."""
    parts = [f"{departure.text} at {departure.stamp:.4g} s" for departure in departures]
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}"


def failure_of(recording: Recording) -> str:
    """What the first error was and where; empty without one."""
    if not recording.errors:
        return ""
    error = recording.errors[0]
    line = failing_line(error)
    place = f", at {line}" if line else ""
    return f"Then `{error.callback}` fails at {error.stamp:.4g} s{place}: {error.type}{error.says}."


def failing_line(error: CallbackError) -> str:
    """The student's line in which an error was raised, such as "line 7: `x = self.last.data`"."""
    frames = list(_FRAME.finditer(error.traceback))
    if not frames:
        return ""
    number = int(frames[-1]["line"])
    source = linecache.getline(frames[-1]["file"], number).strip()
    return f"line {number}: `{source}`" if source else f"line {number}"
