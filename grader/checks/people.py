"""Measures over how near a robot came to people."""

from __future__ import annotations

import itertools
import math
from typing import NamedTuple

from sim.evidence import Recording, Seconds


class Encounter(NamedTuple):
    """A moment at which the robot drove near a person: m from its middle to them, s, and m/s."""

    away: float
    stamp: Seconds
    speed: float


def nearest_person(recording: Recording, faster: float) -> Encounter | None:
    """Where the robot was nearest to somebody of those moments at which it drove faster than that (m/s).

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
