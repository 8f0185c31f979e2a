"""The recorded poses of moving bodies, by body and by time."""

from __future__ import annotations

import bisect
import math
from collections.abc import Sequence

from sim.evidence import Pose, Recording
from sim.world import Body

MAX_POSE_GAP = 0.1  # s; a body without a pose for longer was not in the world


def body_tracks(recording: Recording) -> list[list[Pose]]:
    """The poses of each moving body of a run, in the order of `recording.bodies`."""
    bodies, world = recording.bodies, recording.world
    driven = world.driven_body if bodies and world is not None else None
    return [recording.path if body.name == driven else recording.tracks.get(body.name, []) for body in bodies]


def presence_intervals(track: Sequence[Pose]) -> list[tuple[float, float]]:
    """The intervals (s) in which a body was in the world: turtles can be removed and spawned again."""
    gaps = (i for i in range(1, len(track)) if track[i].stamp - track[i - 1].stamp > MAX_POSE_GAP)
    begins = [0, *gaps]
    lasts = [*(begin - 1 for begin in begins[1:]), len(track) - 1]
    return [(track[begin].stamp, track[last].stamp) for begin, last in zip(begins, lasts, strict=True)]


def index_at(track: Sequence[Pose], stamp: float) -> int:
    """The index of the last pose that is not later than `stamp`; 0 if all are later."""
    return max(bisect.bisect_right(track, stamp + 1e-6, key=lambda pose: pose.stamp) - 1, 0)


def pose_at(track: Sequence[Pose], stamp: float) -> Pose:
    """The last pose that is not later than `stamp`; the first one if all are later."""
    return track[index_at(track, stamp)]


def extent_radius(body: Body) -> float:
    """The distance of the body's farthest point from its origin (m)."""
    return max([body.radius, *(math.hypot(u, v) for u, v in body.outline)])
