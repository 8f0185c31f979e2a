"""Measures over people: how near a robot came to them, and whether what it reports is there."""

from __future__ import annotations

import bisect
import itertools
import math
from collections.abc import Sequence
from typing import NamedTuple

from grader.checks.check import Missed
from grader.geometry.near import is_near
from sim.evidence import Pose, Recording, Seconds

NEAR = 0.6  # m from the middle of a person, a box or a robot to a point of it
LATELY, STEP = 8.0, 0.25  # s for which it is remembered where something moved; of its path
FEW, PART = 10, 0.25  # points near nothing: so many, and this part of them, cost nothing


class Encounter(NamedTuple):
    """A moment at which the robot drove near a person: m from its middle to them, s, and m/s."""

    away: float
    stamp: Seconds
    speed: float


def nearest_person(recording: Recording, faster: float) -> Encounter | None:
    """Return where the robot was nearest to a person while it drove faster than that (m/s).

    None for a robot that never was so fast, or that was alone.
    """
    found = []
    for number, person in enumerate(recording.world.people if recording.world else (), 1):
        there = {pose.stamp: pose for pose in recording.tracks.get(f"person_{number}", [])}
        for before, now in itertools.pairwise(recording.path):
            speed = math.dist(before[1:3], now[1:3]) / (now.stamp - before.stamp)
            if speed > faster and now.stamp in there:
                away = math.dist(now[1:3], there[now.stamp][1:3]) - person.radius
                found.append(Encounter(away, now.stamp, speed))
    return min(found, default=None)


def near_something(
    recording: Recording, stamp: Seconds, topic: str, points: Sequence[tuple[float, float]]
) -> None:
    """Points of a message lie near what stands or moves there, or has moved there lately. Raises Missed."""
    there = {
        (round(pose.x, 1), round(pose.y, 1))
        for track in recording.tracks.values()
        for pose in _lately(track, stamp)
    }
    lost = [point for point in points if not any(is_near(point, place, NEAR) for place in there)]
    if len(lost) > max(FEW, PART * len(points)):
        x, y = lost[0]
        saw = f"{len(lost)} of {len(points)} points at {stamp:.3g} s near nothing, such as {x:.2f}, {y:.2f}"
        hint = "Publish only points that the lidar has seen there."
        raise Missed(f"points on {topic} of what is there", saw, hint)


def _lately(track: Sequence[Pose], stamp: Seconds) -> list[Pose]:
    """The poses of a track at some moments of the last seconds."""
    moments = [stamp - STEP * number for number in range(round(LATELY / STEP) + 1)]
    found = (bisect.bisect_right(track, moment, key=lambda pose: pose.stamp) for moment in moments)
    return [track[max(place - 1, 0)] for place in found] if track else []
