"""Rays of a scan that have no distance, and what each kind of them means."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable

from sim.evidence import Recording, Seconds

_KINDS: dict[str, tuple[Callable[[float], bool], str]] = {
    "inf": (lambda ray: ray == math.inf, "nothing is there"),
    "-inf": (lambda ray: ray == -math.inf, "something is too near to be measured"),
    "nan": (math.isnan, "the ray got lost, and every comparison with nan is False"),
}
NO_WAY = ("-inf", "nan")  # kinds that must not be taken for a free way


def rays_without_distance(
    recording: Recording, node: str, until: Seconds, kinds: Iterable[str] = tuple(_KINDS)
) -> str:
    """The first ray of each of these kinds in the last scan that a node could receive; "" without any."""
    topics = {end.name for end in recording.graph.subscriptions() if end.node == node}
    scans = [
        sent
        for sent in recording.published
        if sent.topic in topics and sent.type == "sensor_msgs/msg/LaserScan" and sent.stamp <= until
    ]
    if not scans:
        return ""
    rays = scans[-1].message.ranges
    found = [
        f"ray {number} is {word} ({meaning})"
        for word, (is_it, meaning) in ((kind, _KINDS[kind]) for kind in kinds)
        if (number := next((n for n, ray in enumerate(rays) if is_it(ray)), None)) is not None
    ]
    return f"In the scan of {scans[-1].stamp:.3g} s {', '.join(found)}." if found else ""
