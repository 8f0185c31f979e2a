"""What all pictures draw: a world as plain data, the tracks of its bodies, and their poses."""

from __future__ import annotations

import bisect
import math
from collections.abc import Sequence
from typing import Any

from sim.evidence import Pose, Recording
from sim.world import Body, World

GAP = 0.1  # s; what left no pose for so long was not there


def world_data(world: World, bodies: Sequence[Body] | None = None) -> dict[str, Any]:
    """All of a world that a page shows, ready for JSON: metres and radians, to a tenth of a millimetre.

    bodies: all that moves, where it is more than at the beginning.

    `checkWorld` in web/checks.js reads it.
    """
    places = {name: _round(place[:2]) for name, place in world.places().items()}
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


def body_tracks(recording: Recording) -> list[list[Pose]]:
    """The poses of each body that moved in a run, in the order of `recording.bodies`."""
    bodies = recording.bodies
    first = recording.world.driven_body if bodies else None
    return [recording.path if body.name == first else recording.tracks.get(body.name, []) for body in bodies]


def stays(track: Sequence[Pose]) -> list[tuple[float, float]]:
    """From when to when (s) a body was there: turtles come and go."""
    begins = [0, *(after for after in range(1, len(track)) if track[after][0] - track[after - 1][0] > GAP)]
    lasts = [*(begin - 1 for begin in begins[1:]), len(track) - 1]
    return [(track[begin].stamp, track[last].stamp) for begin, last in zip(begins, lasts, strict=True)]


def index_at(track: Sequence[Pose], stamp: float) -> int:
    """Where in a track the last pose is that is not later than `stamp`; 0 before that."""
    return max(bisect.bisect_right(track, stamp + 1e-6, key=lambda pose: pose.stamp) - 1, 0)


def pose_at(track: Sequence[Pose], stamp: float) -> Pose:
    """The last pose that is not later than `stamp`; the first one before that."""
    return track[index_at(track, stamp)]


def reach(body: Body) -> float:
    """How far the body's farthest point is from its origin (m)."""
    return max([body.radius, *(math.hypot(u, v) for u, v in body.outline)])


def _round(values: Any) -> list[float]:
    return [round(float(value), 4) for value in values]
