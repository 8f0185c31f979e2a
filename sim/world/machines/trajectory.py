"""A joint trajectory: interpolates waypoints to positions and velocities at any time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

Values = tuple[float, ...]


class Waypoint(NamedTuple):
    """Joint positions at a time (s), and velocities; None if the velocities are not specified."""

    time: float
    positions: Values
    velocities: Values | None = None


class Trajectory:
    """Waypoints with interpolation: cubic if both ends have velocities, linear otherwise.

    Before the first waypoint and after the last the joints stay there.
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
        while points[self._next].time <= time:  # usually called with increasing times
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
