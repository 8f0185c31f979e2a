"""Recordings as files: MCAP, ROS's own recording format, so that `ros2 bag` and Foxglove open them too.

Messages are the file's messages. Everything else (path, contacts, logs, graph, ...) is one JSON attachment.
Nothing in a file is ever executed: no pickle.
"""

from __future__ import annotations

import functools
import json
from base64 import b64decode, b64encode
from collections.abc import Callable
from dataclasses import astuple
from io import BytesIO
from pathlib import Path
from types import UnionType
from typing import Any, ClassVar, TypeVar, get_args, get_origin, get_type_hints

from mcap.reader import make_reader
from mcap.writer import Writer

from sim.evidence.digest import digest_of
from sim.evidence.rows import Message
from sim.evidence.run_data import RunData
from sim.nanoseconds import EPOCH, SECOND
from sim.network import Network
from sim.ros.messages.type_definitions import definition
from sim.world import World, WorldError

ATTACHMENT = "recording.json"
FORMAT = 13  # of the attachment; raise it when what is in there changes
# Fields whose name has changed since files were first written, with the key that files keep.
_KEYS = {
    "course_nodes": "ours",
    "all_exited_at": "gone",
    "undelivered": "unheard",
    "course_errors": "failures",
}
# Fields that came later than the format: older files don't have them.
ADDED = "node_facts", "order", "departures", "end_errors", "end_prints", "end_logs", "epoch"
_YES = {True: "yes", False: "no"}
_D = TypeVar("_D", bound=RunData)
PLAIN = (float, int, str, bool, bytes, Any)


class StorageError(Exception):
    """A file that isn't a recording of this course."""


def write(recording: RunData, path: Path) -> Path:
    """Write a recording to a file."""
    rest = {_KEYS.get(name, name): getattr(recording, name) for name in _rest(type(recording))}
    rest |= {"format": FORMAT, "digest": digest_of(recording)}
    with path.open("wb") as file:
        writer = Writer(file)
        writer.start(profile="ros2", library="sim")
        _write_messages(writer, recording.published, recording.epoch)
        writer.add_attachment(0, 0, ATTACHMENT, "application/json", _pack(rest))
        writer.finish()
    return path


def _pack(rest: dict[str, Any]) -> bytes:
    """As JSON, with bytes as {"base64": text}, and objects as lists of what is in them."""

    def plain(value: Any) -> Any:
        if isinstance(value, World | Network):
            return value.to_data()
        if isinstance(value, bytes):
            return {"base64": b64encode(value).decode()}
        return sorted(value) if isinstance(value, set) else astuple(value)

    return json.dumps(rest, sort_keys=True, default=plain).encode()


def _unpack(data: bytes) -> dict[str, Any]:
    rest: dict[str, Any] = json.loads(
        data, object_hook=lambda item: b64decode(item["base64"]) if "base64" in item else item
    )
    return rest


def _write_messages(writer: Writer, messages: list[Message], epoch: int) -> None:
    schemas: dict[str, int] = {}
    channels: dict[tuple[str, str, str, bool, bool], int] = {}
    for number, (stamp, topic, type_, sender, raw, from_course, early) in enumerate(messages):
        if type_ not in schemas:
            schemas[type_] = writer.register_schema(type_, "ros2msg", definition(type_).encode())
        key = (topic, type_, sender, from_course, early)
        if key not in channels:
            about = {"sender": sender, "ours": _YES[from_course], "early": _YES[early]}
            channels[key] = writer.register_channel(topic, "cdr", schemas[type_], about)
        nanoseconds = epoch + round(stamp * SECOND)
        writer.add_message(channels[key], nanoseconds, raw, nanoseconds, number)


def read(path: Path, kind: type[_D]) -> _D:
    """Read a recording. Raises StorageError with one sentence if the file isn't one."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise StorageError(f"{path} can't be read: {error.strerror}.") from None
    try:
        return _parse(path, data, kind)
    except StorageError:
        raise
    except WorldError as error:
        raise StorageError(f"{path} contains a world that is not possible: {error}") from None
    except Exception as error:  # no list could hold all that a damaged file raises in the libraries below
        raise StorageError(f"{path} is not an MCAP file, or it is damaged ({error}).") from None


def _parse(path: Path, data: bytes, kind: type[_D]) -> _D:
    reader = make_reader(BytesIO(data), validate_crcs=True)
    attachments = {item.name: item.data for item in reader.iter_attachments()}
    if ATTACHMENT not in attachments:
        raise StorageError(
            f"{path} is an MCAP file, but not a recording that this course saved: it has no {ATTACHMENT}."
        )
    rest = _unpack(attachments[ATTACHMENT])
    if rest["format"] != FORMAT:
        raise StorageError(
            f"{path} has format {rest['format']} of a recording; this version of the course reads {FORMAT}."
        )
    epoch = rest.get("epoch", EPOCH)
    published = [
        Message(
            (message.log_time - epoch) / SECOND,
            channel.topic,
            schema.name,
            channel.metadata["sender"],
            message.data,
            channel.metadata["ours"] == _YES[True],
            channel.metadata["early"] == _YES[True],
        )
        for schema, channel, message in reader.iter_messages(log_time_order=False)
        if schema is not None
    ]
    known = {name: hint for name, hint in _rest(kind).items() if name not in ADDED or name in rest}
    restored = {name: _maker(hint)(rest[_KEYS.get(name, name)]) for name, hint in known.items()}
    recording = kind(published=published, **restored)
    if digest_of(recording) != rest["digest"]:
        raise ValueError("its digest differs")
    return recording


def _hints(kind: type) -> dict[str, Any]:
    """The types of the fields of a recording, or of an object in it."""
    hints = get_type_hints(kind)
    return {name: hint for name, hint in hints.items() if get_origin(hint) is not ClassVar}


def _rest(kind: type) -> dict[str, Any]:
    """The fields of a recording other than its messages, and their types."""
    return {name: hint for name, hint in _hints(kind).items() if name != "published"}


@functools.cache
def _maker(hint: Any) -> Callable[[Any], Any]:
    """A function that makes what a field of this type holds of what JSON made of it."""
    kind, inner = get_origin(hint), get_args(hint)
    if hint in PLAIN:
        return _as_it_is
    if hint is World or hint is Network:
        from_data: Callable[[Any], Any] = hint.from_data
        return from_data
    if kind is UnionType:
        make = _maker(inner[0])
        return lambda value: None if value is None else make(value)
    if kind in (list, set):
        make = _maker(inner[0])
        return lambda items: kind(map(make, items))
    if kind is dict:
        make = _maker(inner[1])
        return lambda items: {key: make(item) for key, item in items.items()}
    makers = [_maker(part) for part in (inner if kind is tuple else _hints(hint).values())]
    made = tuple if kind is tuple else lambda values: hint(*values)
    if set(makers) == {_as_it_is}:
        return made
    return lambda values: made([make(value) for make, value in zip(makers, values, strict=True)])


def _as_it_is(value: Any) -> Any:
    return value
