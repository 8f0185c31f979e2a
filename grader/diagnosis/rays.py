"""Rays of a scan that have no distance, and what each kind of them means."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable

from sim.evidence import Message, Recording, Seconds

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
    scan = last_scan(recording, node, until)
    if scan is None:
        return ""
    rays = scan.message.ranges
    found = [
        f"ray {number} is {word} ({meaning})"
        for word, (is_it, meaning) in ((kind, _KINDS[kind]) for kind in kinds)
        if (number := next((n for n, ray in enumerate(rays) if is_it(ray)), None)) is not None
    ]
    return f"In the scan of {scan.stamp:.3g} s {', '.join(found)}." if found else ""


def last_scan(recording: Recording, node: str, until: Seconds) -> Message | None:
    """The last scan that a node could receive."""
    topics = {end.name for end in recording.graph.subscriptions() if end.node == node}
    scans = (
        sent
        for sent in reversed(recording.published)
        if sent.topic in topics and sent.type == "sensor_msgs/msg/LaserScan" and sent.stamp <= until
    )
    return next(scans, None)
