"""Converts a recording to the compact data of a replay: motion, scans, contacts, log lines and topics.

Numbers are whole millimeters, milliradians and milliseconds, stored as differences; then everything is
deflated. The size is bounded for runs of any length, by limits on the number of poses, ranges and lines.
`checkRun` in web/replay.js parses it.
"""

from __future__ import annotations

import json
import math
import zlib
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from sim.evidence import Recording, rate
from sim.view.body_tracks import body_tracks, pose_at, presence_intervals
from sim.view.graph_data import graph_data
from sim.view.last_event import last_event
from sim.view.layers import layers_of, quiet_layers
from sim.view.packing import deflated, differences
from sim.view.replay_values import inspected, strip_of
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
KEY = 12  # hexadecimal digits of a run's key
LEAD = 1.0  # s; a replay opens so long before its first moment
QUIET = 2.0  # s; if less than this happens nothing at the end, it is shown, too
Moment = tuple[float, str]  # stamp (s), text


def pack(recording: Recording, speed: float, moments: Sequence[Moment] = (), plays: bool = False) -> str:
    """The run as base64 of deflated JSON; equal recordings give equal strings.

    speed: the initial speed. moments: marked in red; the replay opens before the first of them.
    plays: it starts to play at once.
    """
    data = {"version": VERSION, "run": run_key(recording), "speed": speed, "world": None}
    data |= {"stamps": [], "tracks": [], "scans": []}
    marks = _marks(recording, moments)
    end = replay_end(recording, moments)
    if end < run_end(recording):
        recording = recording.during(recording.begin, end + 1e-6)
    if moments:
        data["open"] = max(min(stamp for stamp, _ in moments) - LEAD, 0.0)
    data |= {"end": end} | ({"plays": True} if plays else {})
    if recording.world is not None:
        world = world_data(recording.world, recording.bodies)
        data |= {"world": world, **motion(recording), "scans": list(_scans(recording))}
        data |= {"layers": layers_of(recording)}
    data |= quiet_layers(recording)
    if recording.drawing is not None:
        data |= {"drawing": all_strokes(recording.drawing)}
    topics = _topics(recording)
    data |= {"marks": marks, "logs": _logs(recording), "topics": topics, "graph": graph_data(recording)}
    data |= {"strip": strip_of(recording), "messages": inspected(recording, [name for name, *_ in topics])}
    return deflated(data)


def run_key(recording: Recording) -> str:
    """The key of a run: all its pictures on a page have one time cursor."""
    return recording.digest[:KEY]


def replay_end(recording: Recording, moments: Sequence[Moment] = ()) -> float:
    """Return when the replay ends (s): soon after the last thing that happens, or with the run."""
    last = max([last_event(recording), *(stamp for stamp, _ in moments)])
    end = run_end(recording)
    return min(last + LEAD, end) if end - last > QUIET else end


def run_end(recording: Recording) -> float:
    """The duration of the run, in simulated seconds."""
    return recording.stamp if recording.ended.reason == "running" else recording.ended.stamp


def motion(recording: Recording) -> dict[str, Any]:
    """The poses of all bodies, with stamps. Raises ValueError if nothing has moved yet."""
    tracks = body_tracks(recording)
    if not tracks or not all(tracks):
        raise ValueError("nothing has moved in this run yet: it has no pose to draw")
    every = sorted({pose.stamp for track in tracks for pose in track})
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
    world = recording.world
    if not received or not recording.path or world is None:
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
            "pose": [round(value, 3) for value in world.lidar.mounted_at(pose[1:])],
            "start": scan.angle_min,
            "step": scan.angle_increment * stride,
            "far": scan.range_max,
            "ranges": differences([_range(value) for value in scan.ranges[::stride]]),
        }


def _range(value: float) -> int:
    if math.isfinite(value):
        return round(min(max(value, 0), FAR) / RANGE_UNIT)
    return OUT_OF_RANGE if value == math.inf else NOT_MEASURED


def _marks(recording: Recording, moments: Sequence[Moment]) -> list[list[Any]]:
    """The marks of the scrub bar: contacts, errors, what was missed, and the end."""
    marks = event_marks(recording)
    end = (run_end(recording), "end", f"the run ended. {recording.ended.detail}", None)
    return mark_rows(marks, end, [(stamp, "missed", text, None) for stamp, text in moments])


def event_marks(recording: Recording) -> list[Mark]:
    """The robot's contacts, errors in callbacks, and pushes of a cart."""
    marks = contact_marks(recording)
    for error in recording.errors:
        marks.append((error.stamp, "error", f"{error.type} in {error.callback}{error.says}", None))
    machine = recording.world.machine if recording.world is not None else None
    for push in getattr(machine, "pushes", ()):
        if push.begin <= recording.stamp:
            text = f"the cart is pushed with {push.force:g} N for {push.seconds:g} s"
            marks.append((push.begin, "push", text, None))
    return marks


def contact_marks(recording: Recording) -> list[Mark]:
    """The robot's contacts."""
    return [
        (touch.stamp, "contact", f"touched a {touch.what} with its {touch.side}", (touch.x, touch.y))
        for touch in recording.contacts
    ]


def mark_rows(marks: Iterable[Mark], end: Mark, always: Iterable[Mark] = ()) -> list[list[Any]]:
    """The marks in order, limited in number, and those that are always there, such as the end."""
    kept = sorted([*thinned(sorted(marks, key=_stamp_of), MARKS), *always], key=_stamp_of)
    kept.append(end)
    return _limited(
        [
            [round(stamp * 1000), kind, f"t = {stamp:.3g} s: {_short(text)}", _rounded(position)]
            for stamp, kind, text, position in kept
        ]
    )


def _stamp_of(mark: Mark) -> float:
    return mark[0]


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
    return differences([round(value * unit) for value in values])
