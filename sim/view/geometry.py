"""A world as plain data for the pictures in a page; `checkWorld` in web/scene.js reads it."""

from __future__ import annotations

from typing import Any

from sim.world import World


def world_data(world: World) -> dict[str, Any]:
    """All of a world that a picture shows, ready for JSON: metres and radians, to a tenth of a millimetre."""
    return {
        "name": world.name,
        "bounds": _round(world.bounds),
        "goal": _round(world.goal) if world.goal else None,
        "walls": [_round([*start, *end]) for start, end in world.walls],
        "boxes": [[_round(corner) for corner in box.corners()] for box in world.boxes],
        "circles": [_round([pillar.x, pillar.y, pillar.radius]) for pillar in world.circles],
        "bodies": [
            {"name": name, "kind": kind, "radius": radius, "outline": [_round(corner) for corner in outline]}
            for name, kind, radius, outline in world.bodies
        ],
        "lidar": {"start": 0.0, "step": world.lidar.angle_increment, "far": world.lidar.range_max},
    }


def _round(values: Any) -> list[float]:
    return [round(float(value), 4) for value in values]
