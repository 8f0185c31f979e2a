"""What `explore` has found: in which order nodes fail, what was different there, and what failed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from sim.evidence import Departure, Recording
from sim.order import ANY, NETWORK
from sim.ros.exploring.consequences import consequences

NO_PROMISE = "Nothing guarantees the usual order, although the current rclpy always uses it."


@dataclass
class Explored:
    """The result of `explore`.

    failed: the order in which it does not hold, for `run(..., order=found.failed)`; None if it held in all.
    number: that order's number before it was shrunk. tried: the orders that were tried. usual: the run in
    the usual order. recording: the run in the failed order; None if there is none. interrupted: the user
    stopped the search. race: the two accesses whose order makes the difference, in a sentence. stopped: which
    threads still wait at the end, and where. again: in how many of `repeated` further runs in that order it
    did not hold. unseen: code in which no thread was preempted, and why.
    """

    usual: Recording
    failed: str | int | None = None
    number: int = 0
    tried: int = 0
    recording: Recording | None = None
    interrupted: bool = False
    level: str = NETWORK
    race: str = ""
    stopped: list[str] = field(default_factory=list)
    again: int = 0
    repeated: int = 0
    unseen: dict[str, str] = field(default_factory=dict)

    @property
    def departures(self) -> list[Departure]:
        """The choices of the failed order that differ from the usual one."""
        return [] if self.recording is None else list(self.recording.departures)

    @property
    def explanation(self) -> str:
        """Return what was found, in a sentence or two."""
        if self.recording is None:
            stopped = " The search was interrupted." if self.interrupted else ""
            return f"It holds in the usual order and in {self.tried} others.{stopped}{self._unseen}"
        if not self.departures:
            failure = consequences(Recording(), self.recording)
            return f"It does not hold in the usual order. {failure}".rstrip()
        return " ".join(filter(None, self._sentences())) + self._unseen

    def _sentences(self) -> Iterator[str]:
        yield f"In order {self.number}, {list_departures(self.departures)}."
        yield self.race
        yield consequences(self.usual, self.recording, self.stopped)
        yield NO_PROMISE if self.level == ANY else ""
        yield f"It fails again in {self.again} of {self.repeated} runs." if self.repeated else ""
        yield f"Run it again with run(..., order={self.failed!r})."

    @property
    def _unseen(self) -> str:
        """A sentence about the code in which no thread was preempted."""
        reasons: dict[str, list[str]] = {}
        for name, reason in sorted(self.unseen.items()):
            reasons.setdefault(reason, []).append(f"`{name}`")
        parts = [f"{', '.join(names)} ({reason})" for reason, names in reasons.items()]
        return f" No thread was preempted in {' and '.join(parts)}." if parts else ""

    def __repr__(self) -> str:
        return self.explanation

    def _repr_html_(self) -> str:
        from sim.view.order_comparison import comparison  # imported here because it is slow

        return comparison(self.explanation, self.usual, self.recording)


def list_departures(departures: list[Departure]) -> str:
    """Return what came in another order, for the middle of a sentence."""
    parts = [f"{departure.text} at {departure.stamp:.4g} s" for departure in departures]
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}"
