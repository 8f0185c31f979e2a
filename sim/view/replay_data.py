"""Converts a recording to the compact data of a replay: motion, scans, contacts, log lines and topics.

Numbers are whole millimetres, milliradians and milliseconds, stored as differences; then everything is
deflated. The size is bounded for runs of any length, by limits on the number of poses, ranges and lines.
`checkRun` in web/replay.js parses it.
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
from sim.view.body_tracks import body_tracks, pose_at, presence_intervals
from sim.view.graph_data import graph_data
from sim.view.strokes import all_strokes, thinned
from sim.view.world_data import world_data

VERSION = 1
POSES = 8_000  # limit for all bodies together
RANGES = 36_000  # limit for all scans together
SCAN_RATE = 10.0  # Hz; lower if there are more ranges than the limit
RAYS = (60, 180)  # per scan, at least and at most
RANGE_UNIT = 0.02  # m
FAR = 10_000.0  # m; farther than anything in a world
LIDAR = ("sensor_msgs/msg/LaserScan", "/robot")  # type and publisher of the displayed scans
OUT_OF_RANGE, NOT_MEASURED = -1, -2  # instead of a range
MARKS, LOGS, TOPICS, COLUMNS, CHARACTERS = 100, 200, 20, 240, 200
Mark = tuple[float, str, str, tuple[float, float] | None]  # stamp, kind, text, position
TEXT_BYTES = 9_000  # limit of the compressed texts of all marks, and of all log lines


def pack(recording: Recording, speed: float) -> str:
    """The run as base64 of deflated JSON; equal recordings give equal strings. speed: the initial speed."""
    data = {"version": VERSION, "speed": speed, "end": run_end(recording), "world": None}
    data |= {"stamps": [], "tracks": [], "scans": []}
    if recording.world is not None:
        world = world_data(recording.world, recording.bodies)
        data |= {"world": world, **motion(recording), "scans": list(_scans(recording))}
    if recording.drawing is not None:
        data |= {"drawing": all_strokes(recording.drawing)}
    data |= {"marks": _marks(recording), "logs": _logs(recording), "topics": _topics(recording)}
    data["graph"] = graph_data(recording)
    return deflated(data)


def deflated(data: dict[str, Any]) -> str:
    """Data as base64 of deflated JSON."""
    deflate = zlib.compressobj(9, zlib.DEFLATED, -15)
    text = json.dumps(data, separators=(",", ":"), allow_nan=False).encode()
    return base64.b64encode(deflate.compress(text) + deflate.flush()).decode()


def inflated(text: str) -> dict[str, Any]:
    """The inverse of `deflated`."""
    return dict(json.loads(zlib.decompress(base64.b64decode(text), -15)))


def run_end(recording: Recording) -> float:
    """The duration of the run, in simulated seconds."""
    return recording.stamp if recording.ended.reason == "running" else recording.ended.stamp


def motion(recording: Recording) -> dict[str, Any]:
    """The poses of all bodies, with stamps. Raises ValueError if nothing has moved yet."""
    tracks = body_tracks(recording)
    if not tracks or not all(tracks):
        raise ValueError("this run moved nothing yet: it has no pose to draw")
    every = sorted({stamp for track in tracks for stamp in stamps(track)})
    times = thinned(every, POSES // len(tracks))
    columns, there = [], []
    for track in tracks:
        poses = [pose_at(track, time) for time in times]
        columns.append([_scaled_differences((pose[axis] for pose in poses), 1000) for axis in (1, 2, 3)])
        there.append([[round(stamp * 1000) for stamp in interval] for interval in presence_intervals(track)])
    presence = {"there": there} if recording.drawing is not None else {}
    return {"stamps": _scaled_differences(times, 1000), "tracks": columns, **presence}


def _scans(recording: Recording) -> Iterator[dict[str, Any]]:
    received = [item for item in recording.published if (item.type, item.sender) == LIDAR]
    if not received or not recording.path:
        return
    count = max(1, math.ceil(run_end(recording) * SCAN_RATE))
    most = min(max(RANGES // count, RAYS[0]), RAYS[1])
    for item in thinned(received, min(count, RANGES // most)):
        try:
            scan = item.message
        except Exception:  # a student's node with the robot's name sent invalid bytes
            continue
        values = (scan.angle_min, scan.angle_increment, scan.range_max)
        if not len(scan.ranges) or not all(abs(value) < FAR for value in values):
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
    return OUT_OF_RANGE if value == math.inf else NOT_MEASURED


def _marks(recording: Recording) -> list[list[Any]]:
    """The marks of the scrub bar: contacts, errors and the end."""
    marks = contact_marks(recording)
    for error in recording.errors:
        marks.append((error.stamp, "error", f"{error.type} in {error.callback}{error.says}", None))
    end = (run_end(recording), "end", f"the run ended. {recording.ended.detail}", None)
    return mark_rows(marks, end)


def contact_marks(recording: Recording) -> list[Mark]:
    """The robot's contacts."""
    return [
        (touch.stamp, "contact", f"touched a {touch.what} with its {touch.side}", (touch.x, touch.y))
        for touch in recording.contacts
    ]


def mark_rows(marks: Iterable[Mark], end: Mark) -> list[list[Any]]:
    """The marks in order, limited in number, and the end."""
    kept = [*thinned(sorted(marks, key=lambda mark: mark[0]), MARKS), end]
    return _limited(
        [
            [round(stamp * 1000), kind, f"t = {stamp:.3g} s: {_short(text)}", _rounded(position)]
            for stamp, kind, text, position in kept
        ]
    )


def _rounded(position: tuple[float, float] | None) -> list[float] | None:
    return position and [round(value, 3) for value in position]


def _logs(recording: Recording) -> list[list[Any]]:
    return _limited(
        [
            [round(line.stamp * 1000), line.level, _short(f"{line.node}: {line.text}"), None]
            for line in thinned(recording.logs, LOGS)
        ]
    )


def _limited(rows: list[list[Any]]) -> list[list[Any]]:
    """As many of the rows, evenly spaced, as the limit on their compressed size allows."""
    while len(zlib.compress(json.dumps(rows).encode())) > TEXT_BYTES:
        rows = thinned(rows, len(rows) * 3 // 4)
    return rows


def _short(text: str) -> str:
    return text if len(text) <= CHARACTERS else text[: CHARACTERS - 3] + "..."


def _topics(recording: Recording) -> list[list[str]]:
    """Name, rate or count, and a timeline of messages: a 1 for each column with any."""
    times: dict[str, list[float]] = {}
    for item in recording.messages():
        times.setdefault(item.topic, []).append(item.stamp)
    end = run_end(recording)
    rows = []
    for name, when in sorted(times.items())[:TOPICS]:
        busy = {min(int(stamp / end * COLUMNS), COLUMNS - 1) if end else 0 for stamp in when}
        traffic = f"{rate(when):.3g} Hz" if rate(when) else f"{len(when)}"
        rows.append([_short(name), traffic, "".join("01"[column in busy] for column in range(COLUMNS))])
    return rows


def _scaled_differences(values: Iterable[float], unit: float) -> list[int]:
    return _differences([round(value * unit) for value in values])


def _differences(values: Sequence[int]) -> list[int]:
    return [values[0], *(after - now for now, after in pairwise(values))] if values else []
