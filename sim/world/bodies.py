"""`Body`: the shape of a moving body, for pictures."""

from __future__ import annotations

from typing import NamedTuple

from sim.world.obstacles import Point


class Body(NamedTuple):
    """One moving body. Its pose (x, y, yaw) in the map frame changes, its shape does not.

    kind: robot, box, person, link, cart or turtle; it selects the color in pictures. A body with a `radius`
    (m) is a disc; any other is the polygon `outline`, with corners (m) in its own frame, x forward.
    """

    name: str
    kind: str
    radius: float = 0.0
    outline: tuple[Point, ...] = ()
