"""Recordings as files: MCAP, ROS's own recording format, so that `ros2 bag` and Foxglove open them too.

Messages are the file's messages. Everything else (path, contacts, logs, graph, ...) is one JSON attachment.
Nothing in a file
is ever executed: no pickle.
"""

from __future__ import annotations

import json
from base64 import b64decode, b64encode
from collections.abc import Iterator
from dataclasses import asdict, astuple
from io import BytesIO
from pathlib import Path
from typing import Any

from ament_index_python.packages import get_package_share_directory
from mcap.reader import make_reader
from mcap.writer import Writer

from sim.exchanges import Call, Goal
from sim.recording import (
    CallbackError,
    CallbackRun,
    Contact,
    Ended,
    Endpoint,
    Graph,
    Heard,
    LogLine,
    Pose,
    Recording,
    TimerInfo,
)
from sim.ros.fibers import SECOND
from sim.world import World, WorldError

ATTACHMENT = "recording.json"
FORMAT = 3  # of the attachment; raise it when what is in there changes


def _goal(*values: Any) -> Goal:
    goal = Goal(*values)
    goal.events = [(stamp, word) for stamp, word in goal.events]
    goal.feedback = [Heard(*heard) for heard in goal.feedback]
    return goal


ROWS = {
    "calls": Call,
    "goals": _goal,
    "path": Pose,
    "contacts": Contact,
    "logs": LogLine,
    "errors": CallbackError,
    "callbacks": CallbackRun,
}


class StorageError(Exception):
    """A file that isn't a recording of this course."""


def write(recording: Recording, path: Path) -> Path:
    """Write a recording to a file."""
    rest = {
        name: getattr(recording, name)
        for name in (*ROWS, "tracks", "seconds", "seed", "stamp", "prints", "stderr", "ended")
    }
    rest |= {"format": FORMAT, "digest": recording.digest, "graph": asdict(recording.graph)}
    rest["world"] = recording.world.to_data() if recording.world is not None else None
    with path.open("wb") as file:
        writer = Writer(file)
        writer.start(profile="ros2", library="sim")
        _write_messages(writer, recording.heard)
        writer.add_attachment(0, 0, ATTACHMENT, "application/json", _pack(rest))
        writer.finish()
    return path


def _pack(rest: dict[str, Any]) -> bytes:
    """As JSON, with bytes as {"base64": text} and rows as lists."""

    def plain(value: Any) -> Any:
        return {"base64": b64encode(value).decode()} if isinstance(value, bytes) else astuple(value)

    return json.dumps(rest, sort_keys=True, default=plain).encode()


def _unpack(data: bytes) -> dict[str, Any]:
    return json.loads(data, object_hook=lambda item: b64decode(item["base64"]) if "base64" in item else item)


def _write_messages(writer: Writer, heard: list[Heard]) -> None:
    schemas: dict[str, int] = {}
    channels: dict[tuple[str, str, str], int] = {}
    for number, (stamp, topic, type_, sender, raw) in enumerate(heard):
        if type_ not in schemas:
            schemas[type_] = writer.register_schema(type_, "ros2msg", _definition(type_).encode())
        key = (topic, type_, sender)
        if key not in channels:
            channels[key] = writer.register_channel(topic, "cdr", schemas[type_], {"sender": sender})
        nanoseconds = round(stamp * SECOND)
        writer.add_message(channels[key], nanoseconds, raw, nanoseconds, number)


def _definition(type_: str) -> str:
    """A message's definition followed by those it needs, as MCAP's registry asks for encoding "ros2msg"."""
    texts = {name: text for name, text in _definitions(type_, set())}
    main = texts.pop(type_)
    return main + "".join(
        f"\n{'=' * 80}\nMSG: {name.replace('/msg/', '/')}\n{text}" for name, text in texts.items()
    )


def _definitions(type_: str, seen: set[str]) -> Iterator[tuple[str, str]]:
    seen.add(type_)
    package, kind, name = type_.split("/")
    text = (Path(get_package_share_directory(package)) / kind / f"{name}.msg").read_text()
    yield type_, text
    for line in text.splitlines():
        word = line.split("#")[0].split("[")[0].split("<")[0].split()
        needs = word[0] if word else ""
        if "/" in needs:
            needs = needs.replace("/", "/msg/", 1)
        elif needs[:1].isupper():
            needs = f"{package}/msg/{needs}"
        else:
            continue
        if needs not in seen:
            yield from _definitions(needs, seen)


def read(path: Path) -> Recording:
    """Read a recording. Raises StorageError with one sentence if the file isn't one."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise StorageError(f"{path} can't be read: {error.strerror}.") from None
    try:
        return _parse(path, data)
    except StorageError:
        raise
    except WorldError as error:
        raise StorageError(f"{path} holds a world that cannot be: {error}") from None
    except Exception as error:  # no list could hold all that a damaged file raises in the libraries below
        raise StorageError(f"{path} is not an MCAP file, or it is damaged ({error}).") from None


def _parse(path: Path, data: bytes) -> Recording:
    reader = make_reader(BytesIO(data), validate_crcs=True)
    attachments = {item.name: item.data for item in reader.iter_attachments()}
    if ATTACHMENT not in attachments:
        raise StorageError(
            f"{path} is an MCAP file, but no recording that this course saved: it has no {ATTACHMENT}."
        )
    rest = _unpack(attachments[ATTACHMENT])
    if rest["format"] != FORMAT:
        raise StorageError(
            f"{path} has format {rest['format']} of a recording; this version of the course reads {FORMAT}."
        )
    recording = _recording(rest, [message for _, message in sorted(_heard(reader))])
    if recording.digest != rest["digest"]:
        raise ValueError("its digest is another")
    return recording


def _heard(reader: Any) -> Iterator[tuple[int, Heard]]:
    for schema, channel, message in reader.iter_messages():
        stamp = message.log_time / SECOND
        yield (
            message.sequence,
            Heard(stamp, channel.topic, schema.name, channel.metadata["sender"], message.data),
        )


def _recording(rest: dict[str, Any], heard: list[Heard]) -> Recording:
    recording = Recording(
        heard=heard, **{name: rest[name] for name in ("seconds", "seed", "stamp", "stderr")}
    )
    for name, row in ROWS.items():
        setattr(recording, name, [row(*values) for values in rest[name]])
    recording.tracks = {name: [Pose(*values) for values in poses] for name, poses in rest["tracks"].items()}
    graph = rest["graph"]
    recording.graph = Graph(
        graph["nodes"], [Endpoint(*e) for e in graph["endpoints"]], [TimerInfo(*t) for t in graph["timers"]]
    )
    recording.prints = [(stamp, text) for stamp, text in rest["prints"]]
    recording.ended = Ended(*rest["ended"])
    recording.world = World.from_data(rest["world"]) if rest["world"] is not None else None
    return recording
