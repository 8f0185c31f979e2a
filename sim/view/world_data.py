"""A world as plain data for the pages that draw it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sim.world import Body, World


def world_data(world: World, bodies: Sequence[Body] | None = None) -> dict[str, Any]:
    """The data of a world for a page, ready for JSON: meters and radians, rounded to a tenth of a millimeter.

    bodies: the moving bodies, if some were added during the run.

    `checkWorld` in web/checks.js parses it.
    """
    places = {name: _round(pose[:2]) for name, pose in world.places().items()}
    return ({"places": places} if places else {}) | {
        "name": world.name,
        "bounds": _round(world.bounds),
        "goal": _round(world.goal) if world.goal else None,
        "walls": [_round([*start, *end]) for start, end in world.walls],
        "boxes": [[_round(corner) for corner in box.corners()] for box in world.boxes],
        "circles": [_round([pillar.x, pillar.y, pillar.radius]) for pillar in world.circles],
        "bodies": [
            {"name": name, "kind": kind, "radius": radius, "outline": [_round(corner) for corner in outline]}
            for name, kind, radius, outline in bodies or world.bodies
        ],
        "lidar": {"start": 0.0, "step": world.lidar.angle_increment, "far": world.lidar.range_max},
    }


def _round(values: Any) -> list[float]:
    return [round(float(value), 4) for value in values]
