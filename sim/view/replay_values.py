"""Values of a replay at each moment: the strip of numbers, and the messages of its topics as text."""

from __future__ import annotations

import bisect
import json
import math
import zlib
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any

from sim.evidence import Message, Recording, stamps
from sim.evidence.message_text import decoded, field_lines, numbers_to_plot, single_numbers, text_lines
from sim.evidence.readings import readings
from sim.view.body_tracks import pose_at
from sim.view.packing import differences
from sim.view.strokes import thinned

SAMPLES = 300  # moments of the strip
MESSAGES = (120, 60, 30, 15, 6)  # stored of each topic: the first number whose texts are within the limit
TEXT_BYTES = 16_000  # limit of the compressed texts of all topics
MAX_CURVES = 2
ORDER = "warehouse_msgs/msg/Order"
ROBOT = "/robot"  # the node whose scans are read


def strip_of(recording: Recording) -> dict[str, Any]:
    """The strip of values: labels, stamps (ms, as differences), and a list of texts for each label.

    A text is "" where nothing is shown, and 0 where it is that of the moment before.
    """
    if recording.world is None:
        return {"labels": [], "stamps": [], "values": []}
    newest, orders = _newest(recording), _orders(recording)
    moments = thinned(_moments(recording), SAMPLES)
    rows = [dict(_readings_at(recording, moment, newest, orders)) for moment in moments]
    labels = list(dict.fromkeys(label for row in reversed(rows) for label in row))
    columns = [[row.get(label, "") for row in rows] for label in labels]
    whole = [round(moment * 1000) for moment in moments]
    values = [_changes(column) for column in columns]
    return {"labels": labels, "stamps": differences(whole), "values": values}


def _moments(recording: Recording) -> list[float]:
    """Return when the strip may change."""
    if recording.path:
        return [pose.stamp for pose in recording.path]
    return sorted({item.stamp for item in recording.published})


def _orders(recording: Recording) -> list[tuple[float, Any]]:
    """The messages of a warehouse's desk, with their stamps."""
    if recording.world is None or recording.world.warehouse is None:
        return []
    return [(item.stamp, decoded(item)) for item in recording.messages("/orders") if item.type == ORDER]


def _readings_at(
    recording: Recording, moment: float, newest: Callable[..., Any], orders: Sequence[tuple[float, Any]]
) -> Any:
    path, world = recording.path, recording.world
    driven = None if world is None else world.driven_body
    pose = pose_at(path, moment)[1:4] if path and driven is not None else None
    placed = [order for stamp, order in orders if order is not None and stamp <= moment + 1e-6]
    contacts = [contact for contact in recording.contacts if contact.stamp <= moment + 1e-6]

    def at(topic: str, *kinds: str) -> Any:
        return newest(moment, topic, *kinds)

    scan = newest(moment, "/scan", "sensor_msgs/msg/LaserScan", sender=ROBOT)
    return readings(world, pose, at, None if scan is None else scan.ranges, contacts, placed)


def _newest(recording: Recording) -> Callable[..., Any]:
    """A function of a moment, a topic, its types and a sender: the newest message until then, or None."""
    found: dict[tuple[str, str | None], tuple[list[float], list[Message]]] = {}

    def newest(moment: float, topic: str, *kinds: str, sender: str | None = None) -> Any:
        if (topic, sender) not in found:
            items = recording.messages(topic, sender)
            found[topic, sender] = stamps(items), items
        times, items = found[topic, sender]
        index = bisect.bisect_right(times, moment + 1e-6) - 1
        return decoded(items[index]) if index >= 0 and items[index].type in kinds else None

    return newest


def _changes(values: Sequence[str]) -> list[str | int]:
    return [*values[:1], *(0 if after == now else after for now, after in pairwise(values))]


def inspected(recording: Recording, topics: Sequence[str]) -> list[dict[str, Any]]:
    """For each topic its type, the stamps (ms) and texts of some messages, evenly spaced, and its curves.

    Each text is a list of lines; a line is 0 if it is that of the message before. curves: of numbers that
    change, pairs of a field and the index of its line, or of a joint's name and its value in each message,
    None where the message has another driver's joints. The compressed size of all is limited.
    """
    kinds = recording.topics
    for most in MESSAGES:
        found = [_inspected(recording.messages(topic), kinds.get(topic, ""), most) for topic in topics]
        if len(zlib.compress(json.dumps(found).encode())) <= TEXT_BYTES:
            return found
    return [{**topic, "stamps": [], "texts": [], "curves": []} for topic in found]


def _inspected(items: Sequence[Message], kind: str, most: int) -> dict[str, Any]:
    readable = [(item, message) for item in thinned(items, most) if (message := decoded(item)) is not None]
    lines = [text_lines(message) for _, message in readable]
    texts = [*lines[:1], *(_changed_lines(now, after) for now, after in pairwise(lines))]
    return {
        "type": kind,
        "count": len(items),
        "stamps": [round(item.stamp * 1000) for item, _ in readable],
        "texts": texts,
        "curves": _curves([message for _, message in readable], lines),
    }


def _changed_lines(now: list[str], after: list[str]) -> list[str | int]:
    return [0 if index < len(now) and now[index] == line else line for index, line in enumerate(after)]


def _curves(messages: Sequence[Any], lines: Sequence[list[str]]) -> list[list[Any]]:
    if not messages or len({len(text) for text in lines}) > 1:
        return []
    known = {field: line for line, (field, _) in enumerate(field_lines(messages[0])) if line < len(lines[0])}
    rows = [dict(numbers_to_plot(message)) for message in messages]
    fields = [field for field in dict.fromkeys(field for row in rows for field in row)
              if field in known or field not in dict(single_numbers(messages[0]))]
    changing = [field for field in fields if len({_rounded(row[field]) for row in rows if field in row}) > 1]
    return [
        [field, known.get(field, [_rounded(row.get(field, math.nan)) for row in rows])]
        for field in (changing or fields)[:MAX_CURVES]
    ]


def _rounded(value: float) -> float | None:
    """The value as texts show it; None for NaN and infinities."""
    return float(f"{value:.4g}") if math.isfinite(value) else None
