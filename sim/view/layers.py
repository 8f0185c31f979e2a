"""Messages as layers of a world's picture: of a whole run for a replay, or the newest of one that goes on."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
from typing import Any

from sim.evidence import Message, Recording
from sim.evidence.message_text import TopicMessage, decoded
from sim.view.frame_tree import FrameTree
from sim.view.layer_kinds import QUIET, frame_data, kind_of, layer_data
from sim.view.packing import differences
from sim.view.strokes import thinned
from sim.world import World

MOST = {"map": 6, "plan": 60, "goal": 60, "pose": 120, "frames": 120, "cloud": 40, "image": 12}
TF = "/tf"  # stands for all frames
TOPICS, FRAMES, NAME = 8, 20, 200  # limits of topics, frames, and characters of a name
UNITS = {"pose": (1e3, 1e3, 1e3, 1e6, 1e6, 1e6), "frames": (1e3,) * 6}  # of stored whole numbers
Layer = dict[str, Any]  # stamp (ms), topic, kind, data, and of a frame its name


def layers_of(recording: Recording, *, quiet: bool = False) -> list[Layer]:
    """The layers of a run in the order of time: those that are always drawn, or the quiet ones."""
    frames = FrameTree(recording.world)
    found: list[Layer] = []
    for item in _chosen(recording, quiet):
        if _kind(item) == "frames":
            frames.add(decoded(item))
            found.extend(_frames(frames, item.stamp) if quiet else ())
        else:
            found.extend(_layers([item], frames))
    return found


def _chosen(recording: Recording, quiet: bool) -> list[Message]:
    """Some messages of each topic, and the transforms, in the order of time."""
    topics: dict[tuple[str, str], list[Message]] = {}
    for item in recording.published:
        kind = kind_of(item.topic, item.type)
        if kind == "frames" or (kind is not None and (kind in QUIET) == quiet):
            sender = item.sender if kind == "frames" else ""
            topics.setdefault((item.topic, sender), []).append(item)
    transforms = {key: items for key, items in topics.items() if _kind(items[0]) == "frames"}
    others = [items for key, items in sorted(topics.items()) if key not in transforms][:TOPICS]
    kept = [thinned(items, MOST[_kind(items[0])]) for items in (*transforms.values(), *others)]
    return sorted(itertools.chain(*kept), key=lambda item: (item.stamp, _kind(item) != "frames"))


def quiet_layers(recording: Recording) -> dict[str, list[Layer]]:
    """The quiet layers of a run for a replay: `seen`, clouds and images, and `beliefs`, poses and frames.

    A pose or frame has its stamps (ms) and columns of whole numbers, all as differences. Without a world
    there are only images.
    """
    layers = layers_of(recording, quiet=True)
    if recording.world is None:
        layers = [layer for layer in layers if layer["kind"] == "image"]
    tracks: dict[tuple[str, str], list[Layer]] = {}
    for layer in layers:
        if layer["kind"] in UNITS:
            tracks.setdefault((layer["topic"], layer.get("name", "")), []).append(layer)
    seen = [layer for layer in layers if layer["kind"] not in UNITS]
    return {"seen": seen, "beliefs": [_track(rows) for rows in tracks.values()]}


def _track(rows: list[Layer]) -> Layer:
    """The layers of one pose or frame as columns."""
    kind, rows = rows[0]["kind"], thinned(rows, MOST[rows[0]["kind"]])
    columns = zip(UNITS[kind], zip(*(row["data"] for row in rows), strict=True), strict=True)
    return {
        **{"topic": rows[0]["topic"], "kind": kind, "name": rows[0].get("name", "")},
        "stamps": differences([row["stamp"] for row in rows]),
        "columns": [differences([round(value * unit) for value in column]) for unit, column in columns],
    }


def _kind(item: TopicMessage) -> str:
    return kind_of(item.topic, item.type) or ""


def _layers(items: Iterable[TopicMessage], frames: FrameTree) -> Iterator[Layer]:
    """The layers in messages that are no transforms."""
    for item in items:
        kind = _kind(item)
        try:
            data = layer_data(kind, item.message, frames)
        except Exception:  # a student's node sent invalid bytes, or values that are not in any world
            continue
        if data is not None:
            yield {"stamp": round(item.stamp * 1000), "topic": item.topic[:NAME], "kind": kind, "data": data}


def _frames(frames: FrameTree, stamp: float) -> Iterator[Layer]:
    """The frames that are on the map."""
    for name in frames.names[:FRAMES]:
        place = frames.where(name)
        if place is not None:
            about = {"stamp": round(stamp * 1000), "topic": TF, "kind": "frames"}
            yield {**about, "name": name[:NAME], "data": frame_data(place)}


class NewestLayers:
    """The newest layer of each topic while a run continues. world: its world, which places the odom frame."""

    def __init__(self, world: World | None = None) -> None:
        self._looked = 0  # at so many messages
        self._newest: dict[str, TopicMessage] = {}
        self._drawn: dict[str, tuple[TopicMessage, list[Layer]]] = {}  # of each topic, with its message
        self._frames = FrameTree(world)
        self._changed = False  # what is always drawn, since the last call of `changed`

    def read(self, recording: Recording) -> None:
        """Take note of what was published since the last call."""
        new, self._looked = recording.published[self._looked :], len(recording.published)
        for item in new:
            self.add(item)

    def add(self, item: TopicMessage) -> None:
        """Take note of a message."""
        if _kind(item) == "frames":
            self._frames.add(decoded(item))
        elif _kind(item):
            self._newest[item.topic] = item
            self._changed |= _kind(item) not in QUIET

    def changed(self) -> list[Layer] | None:
        """The layers that are always drawn, if there is a new one; None if nothing has changed."""
        changed, self._changed = self._changed, False
        loud = [topic for topic, item in self._newest.items() if _kind(item) not in QUIET]
        return self._layers(loud[:TOPICS]) if changed else None

    @property
    def quiet(self) -> list[list[str]]:
        """The topics whose layers the reader can ask for: pairs of name and kind."""
        kinds = {TF: "frames"} if self._frames.names else {}
        kinds |= {item.topic: _kind(item) for item in self._newest.values() if _kind(item) in QUIET}
        return [[topic[:NAME], kind] for topic, kind in sorted(kinds.items())[:TOPICS]]

    def moving(self, stamp: float, topics: Iterable[str]) -> list[Layer]:
        """The newest quiet layers of these topics, at a time (s)."""
        frames = _frames(self._frames, stamp) if TF in topics else ()
        return [*self._layers(topics), *frames]

    def _layers(self, topics: Iterable[str]) -> list[Layer]:
        """Those of the newest messages; each message is converted once."""
        found = []
        for item in (self._newest[topic] for topic in topics if topic in self._newest):
            if self._drawn.get(item.topic, (None,))[0] is not item:
                self._drawn[item.topic] = item, list(_layers([item], self._frames))
            found.extend(self._drawn[item.topic][1])
        return found
