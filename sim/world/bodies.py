"""What moves in a world, as it is drawn: each body has a shape of its own and a pose in the map frame."""

from __future__ import annotations

from typing import NamedTuple

from sim.world.obstacles import Point


class Body(NamedTuple):
    """One thing that moves. Its pose (x, y, yaw) in the map frame changes, its shape does not.

    kind: robot, box, person, link, cart or turtle; pictures colour it by that. A body with a `radius` (m) is
    a disc; any other is the polygon `outline`, whose corners (m) are given in its own frame, x forward.
    """

    name: str
    kind: str
    radius: float = 0.0
    outline: tuple[Point, ...] = ()
