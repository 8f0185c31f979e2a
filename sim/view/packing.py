"""A recording as a small text for a page: what moved, what was seen, felt, said and sent, by whom.

Numbers are whole millimetres, milliradians and milliseconds, written as differences; then all is deflated.
However long a run was, the text stays bounded: there are so many poses, ranges and lines and no more.
`checkRun` in web/replay.js reads it.
"""

from __future__ import annotations

import base64
import json
import math
import zlib
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import Any

from sim.evidence import Recording, rate, stamps
from sim.view.drawing import packed, thinned
from sim.view.geometry import body_tracks, pose_at, stays, world_data
from sim.view.graph_data import graph_data

VERSION = 1
POSES = 8_000  # of all bodies together
RANGES = 36_000  # of all scans together
SCAN_RATE = 10.0  # Hz, as long as there are ranges enough
RAYS = (60, 180)  # in a scan, at least and at most
RANGE_UNIT = 0.02  # m
FAR = 10_000.0  # m; nothing in a world is farther away
LIDAR = ("sensor_msgs/msg/LaserScan", "/robot")  # type and sender of the scans that are shown
NOTHING_NEAR, NOT_MEASURED = -1, -2  # in place of a range
MARKS, LOGS, TOPICS, COLUMNS, CHARACTERS = 100, 200, 20, 240, 200
Mark = tuple[float, str, str, tuple[float, float] | None]  # stamp, kind, words, place
WORDS = 9_000  # bytes, packed, of all marks together, and of all log lines; there are no more than fit


def pack(recording: Recording, speed: float) -> str:
    """The run as base64 of deflated JSON; equal recordings give equal texts. speed: to begin with."""
    data = {"version": VERSION, "speed": speed, "end": run_end(recording), "world": None}
    data |= {"stamps": [], "tracks": [], "scans": []}
    if recording.world is not None:
        world = world_data(recording.world, recording.bodies)
        data |= {"world": world, **motion(recording), "scans": list(_scans(recording))}
    if recording.drawing is not None:
        data |= {"drawing": packed(recording.drawing)}
    data |= {"marks": _marks(recording), "logs": _logs(recording), "topics": _topics(recording)}
    data["graph"] = graph_data(recording)
    return deflated(data)


def deflated(data: dict[str, Any]) -> str:
    """A page's data as base64 of deflated JSON."""
    deflate = zlib.compressobj(9, zlib.DEFLATED, -15)
    text = json.dumps(data, separators=(",", ":"), allow_nan=False).encode()
    return base64.b64encode(deflate.compress(text) + deflate.flush()).decode()


def inflated(text: str) -> dict[str, Any]:
    """What `deflated` was given."""
    return dict(json.loads(zlib.decompress(base64.b64decode(text), -15)))


def run_end(recording: Recording) -> float:
    """How long the run lasted, in simulated seconds."""
    return recording.stamp if recording.ended.reason == "running" else recording.ended.stamp


def motion(recording: Recording) -> dict[str, Any]:
    """Where all bodies were, and when. Raises ValueError where nothing has moved yet."""
    tracks = body_tracks(recording)
    if not tracks or not all(tracks):
        raise ValueError("this run moved nothing yet: it has no pose to draw")
    every = sorted({stamp for track in tracks for stamp in stamps(track)})
    moments = thinned(every, POSES // len(tracks))
    columns, there = [], []
    for track in tracks:
        poses = [pose_at(track, moment) for moment in moments]
        columns.append([_steps((pose[axis] for pose in poses), 1000) for axis in (1, 2, 3)])
        there.append([[round(stamp * 1000) for stamp in stay] for stay in stays(track)])
    come_and_go = {"there": there} if recording.drawing is not None else {}
    return {"stamps": _steps(moments, 1000), "tracks": columns, **come_and_go}


def _scans(recording: Recording) -> Iterator[dict[str, Any]]:
    heard = [item for item in recording.published if (item.type, item.sender) == LIDAR]
    if not heard or not recording.path:
        return
    wanted = max(1, math.ceil(run_end(recording) * SCAN_RATE))
    most = min(max(RANGES // wanted, RAYS[0]), RAYS[1])
    for item in thinned(heard, min(wanted, RANGES // most)):
        try:
            scan = item.message
        except Exception:  # a student's node of the robot's name sent bytes that are no scan
            continue
        figures = (scan.angle_min, scan.angle_increment, scan.range_max)
        if not len(scan.ranges) or not all(abs(figure) < FAR for figure in figures):
            continue
        stride = max(1, math.ceil(len(scan.ranges) / most))
        pose = pose_at(recording.path, item.stamp)
        yield {
            "stamp": round(item.stamp * 1000),
            "pose": [round(value, 3) for value in recording.world.lidar.mounted_at(pose[1:])],
            "start": scan.angle_min,
            "step": scan.angle_increment * stride,
            "far": scan.range_max,
            "ranges": _differences([_range(value) for value in scan.ranges[::stride]]),
        }


def _range(value: float) -> int:
    if math.isfinite(value):
        return round(min(max(value, 0), FAR) / RANGE_UNIT)
    return NOTHING_NEAR if value == math.inf else NOT_MEASURED


def _marks(recording: Recording) -> list[list[Any]]:
    """What the scrub bar points at: contacts, errors and the end."""
    marks = touches(recording)
    for error in recording.errors:
        marks.append((error.stamp, "error", f"{error.type} in {error.callback}{error.says}", None))
    end = (run_end(recording), "end", f"the run ended. {recording.ended.detail}", None)
    return mark_rows(marks, end)


def touches(recording: Recording) -> list[Mark]:
    """What the robot touched."""
    return [
        (touch.stamp, "contact", f"touched a {touch.what} with its {touch.side}", (touch.x, touch.y))
        for touch in recording.contacts
    ]


def mark_rows(marks: Iterable[Mark], end: Mark) -> list[list[Any]]:
    """The marks in order, no more of them than a page shows, and the end."""
    kept = [*thinned(sorted(marks, key=lambda mark: mark[0]), MARKS), end]
    return _fitting(
        [
            [round(stamp * 1000), kind, f"t = {stamp:.3g} s: {_short(words)}", _place(place)]
            for stamp, kind, words, place in kept
        ]
    )


def _place(place: tuple[float, float] | None) -> list[float] | None:
    return place and [round(value, 3) for value in place]


def _logs(recording: Recording) -> list[list[Any]]:
    return _fitting(
        [
            [round(line.stamp * 1000), line.level, _short(f"{line.node}: {line.text}"), None]
            for line in thinned(recording.logs, LOGS)
        ]
    )


def _fitting(rows: list[list[Any]]) -> list[list[Any]]:
    """So many of the rows, evenly spread, that they aren't too long together."""
    while len(zlib.compress(json.dumps(rows).encode())) > WORDS:
        rows = thinned(rows, len(rows) * 3 // 4)
    return rows


def _short(text: str) -> str:
    return text if len(text) <= CHARACTERS else text[: CHARACTERS - 3] + "..."


def _topics(recording: Recording) -> list[list[str]]:
    """Name, count and rate, and when there were messages: a 1 for each column of the timeline with any."""
    moments: dict[str, list[float]] = {}
    for item in recording.messages():
        moments.setdefault(item.topic, []).append(item.stamp)
    end = run_end(recording)
    rows = []
    for name, when in sorted(moments.items())[:TOPICS]:
        busy = {min(int(stamp / end * COLUMNS), COLUMNS - 1) if end else 0 for stamp in when}
        told = f"{rate(when):.3g} Hz" if rate(when) else f"{len(when)}"
        rows.append([_short(name), told, "".join("01"[column in busy] for column in range(COLUMNS))])
    return rows


def _steps(values: Iterable[float], unit: float) -> list[int]:
    return _differences([round(value * unit) for value in values])


def _differences(values: Sequence[int]) -> list[int]:
    return [values[0], *(after - now for now, after in pairwise(values))] if values else []
