"""A path through joint positions in time: what the joints should do at any moment of it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

Values = tuple[float, ...]


class Waypoint(NamedTuple):
    """Where the joints should be at a time (s), and how fast they turn then; None: where only that counts."""

    time: float
    positions: Values
    velocities: Values | None = None


class Trajectory:
    """Waypoints and what lies between: cubic where both ends have velocities, straight where not.

    Before the first waypoint and behind the last the joints stand still there.
    """

    def __init__(self, waypoints: Sequence[Waypoint]) -> None:
        self.waypoints = tuple(waypoints)
        self._next = 1

    @property
    def end(self) -> float:
        """The time of the last waypoint, s."""
        return self.waypoints[-1].time

    def at(self, time: float) -> tuple[Values, Values]:
        """Positions (rad) and velocities (rad/s) at a time (s)."""
        points = self.waypoints
        if time < points[0].time or time >= self.end:
            still = points[0] if time < points[0].time else points[-1]
            return still.positions, (0.0,) * len(still.positions)
        while points[self._next].time <= time:  # mostly asked about later and later times
            self._next += 1
        while points[self._next - 1].time > time:
            self._next -= 1
        return _between(points[self._next - 1], points[self._next], time)


def _between(a: Waypoint, b: Waypoint, time: float) -> tuple[Values, Values]:
    span = b.time - a.time
    u = (time - a.time) / span
    slopes = [(q1 - q0) / span for q0, q1 in zip(a.positions, b.positions, strict=True)]
    if a.velocities is None or b.velocities is None:
        return tuple(
            q + slope * (time - a.time) for q, slope in zip(a.positions, slopes, strict=True)
        ), tuple(slopes)
    positions, velocities = [], []
    for q, slope, v0, v1 in zip(a.positions, slopes, a.velocities, b.velocities, strict=True):
        # q(u) = q + span (v0 u + second u^2 + third u^3) meets both positions and both velocities.
        second, third = 3 * slope - 2 * v0 - v1, v0 + v1 - 2 * slope
        positions.append(q + span * u * (v0 + u * (second + u * third)))
        velocities.append(v0 + u * (2 * second + 3 * u * third))
    return tuple(positions), tuple(velocities)
