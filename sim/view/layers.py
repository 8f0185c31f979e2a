"""Maps, plans and goals that nodes published, as layers of a world's picture.

Only those in the frame `map` are drawn, which is the world's. `checkLayer` in web/layers.js parses them.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable
from typing import Any

import numpy as np

from sim.evidence import Message, Recording
from sim.view.strokes import thinned

KINDS = {
    "nav_msgs/msg/OccupancyGrid": "map",
    "nav_msgs/msg/Path": "plan",
    "geometry_msgs/msg/PoseStamped": "goal",
}
FRAME = "map"
MOST = {"map": 6, "plan": 60, "goal": 60}  # messages of a topic that a replay has
TOPICS = 6
CELLS, POINTS, TOPIC = 160_000, 200, 200  # limits of a map, a plan and a name
FAR = 10_000.0  # m; farther than anything in a world


def is_layer(item: Message) -> bool:
    """Whether a message may be a layer: a map, a plan, or a pose on a topic whose name has the word goal."""
    return item.type in KINDS and (KINDS[item.type] != "goal" or "goal" in item.topic)


def layers_of(recording: Recording) -> list[dict[str, Any]]:
    """The layers of a run for a replay, in the order of time."""
    topics: dict[str, list[Message]] = {}
    for item in filter(is_layer, recording.published):
        topics.setdefault(item.topic, []).append(item)
    chosen = [thinned(items, MOST[KINDS[items[0].type]]) for _, items in sorted(topics.items())[:TOPICS]]
    return as_data(sorted(itertools.chain(*chosen), key=lambda item: item.stamp))


def as_data(items: Iterable[Message]) -> list[dict[str, Any]]:
    """The layers in these messages, ready for JSON: meters, radians, milliseconds."""
    found = []
    for item in items:
        kind = KINDS[item.type]
        try:
            message = item.message
            data = _CONVERTERS[kind](message) if message.header.frame_id.lstrip("/") == FRAME else None
        except Exception:  # a student's node sent invalid bytes, or values that are not in any world
            continue
        if data is not None:
            about = {"stamp": round(item.stamp * 1000), "topic": item.topic[:TOPIC], "kind": kind}
            found.append({**about, "data": data})
    return found


def _grid(message: Any) -> dict[str, Any] | None:
    """A map as runs of equal cells, row by row; larger cells if it has too many; None if it is turned."""
    info, origin = message.info, message.info.origin
    count = info.width * info.height
    if not count or len(message.data) != count or abs(origin.orientation.z) > 1e-3:
        return None
    step = math.ceil(math.sqrt(max(count / CELLS, 1)))
    cells = np.array(message.data, dtype=np.int16).reshape(info.height, info.width)
    for axis, size in enumerate(cells.shape):
        cells = np.maximum.reduceat(cells, range(0, size, step), axis)
    groups = itertools.groupby(np.clip(cells, -1, 100).ravel().tolist())
    runs = [[value, len(list(group))] for value, group in groups]
    place = _meters(origin.position.x, origin.position.y, info.resolution * step)
    return {"width": cells.shape[1], "place": place, "runs": runs}


def _plan(message: Any) -> list[list[float]]:
    positions = (pose.pose.position for pose in thinned(message.poses, POINTS))
    return [_meters(position.x, position.y) for position in positions]


def _goal(message: Any) -> list[float]:
    position, turn = message.pose.position, message.pose.orientation
    return _meters(position.x, position.y, 2 * math.atan2(turn.z, turn.w))


def _meters(*values: float) -> list[float]:
    """The values, rounded. Raises ValueError if one is in no world, such as NaN."""
    if not all(abs(value) < FAR for value in values):
        raise ValueError(f"{values} is too far")
    return [round(float(value), 4) for value in values]


_CONVERTERS = {"map": _grid, "plan": _plan, "goal": _goal}


class NewestLayers:
    """The newest layer of each topic while a run goes on."""

    def __init__(self) -> None:
        self._looked = 0  # at so many messages
        self._newest: dict[str, Message] = {}

    def update(self, recording: Recording) -> list[dict[str, Any]] | None:
        """The layers, if there is a new one; None if nothing has changed."""
        published = recording.published
        new = {item.topic: item for item in published[self._looked :] if is_layer(item)}
        self._looked = len(published)
        self._newest |= new
        return as_data(list(self._newest.values())[:TOPICS]) if new else None
