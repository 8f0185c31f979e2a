"""Bags: folders of recorded messages in MCAP files, as `ros2 bag` writes and reads them."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml
from mcap.reader import make_reader
from mcap.records import Channel, Schema
from mcap.writer import Writer

from sim.distro import DISTRO
from sim.nanoseconds import SECOND, Nanoseconds
from sim.ros.messages.type_definitions import definition
from sim.ros2.system import CliError, ReceivedMessage

RELIABILITIES, DURABILITIES = ("", "reliable", "best_effort"), ("", "transient_local", "volatile")
QOS = "offered_qos_profiles"  # key in a channel's metadata
VERSION = 8  # of metadata.yaml


class BagWriter:
    """Writes one bag; a context manager. Raises CliError if the folder exists or can't be created.

    epoch: as `System.epoch`.
    """

    def __init__(self, folder: Path, epoch: Nanoseconds) -> None:
        self.folder, self.file = folder, folder / f"{folder.name}_0.mcap"
        try:
            folder.mkdir(parents=True)
        except FileExistsError:
            raise CliError(f"Output folder '{folder}' already exists.") from None
        except OSError as error:
            raise CliError(f"Output folder '{folder}' can't be made: {error.strerror}.") from None
        self._writer, self._epoch = Writer(str(self.file)), epoch
        self._channels: dict[str, int] = {}
        self.counts: Counter[str] = Counter()
        self._types: dict[str, str] = {}
        self._span: list[int] = []

    def __enter__(self) -> BagWriter:
        self._writer.start("ros2", "ros2-notebook-course")
        return self

    def __exit__(self, *exception: object) -> None:
        self._writer.finish()
        (self.folder / "metadata.yaml").write_text(yaml.safe_dump(self._metadata(), sort_keys=False))

    def write(self, message: ReceivedMessage, qos: dict[str, Any]) -> None:
        """Add a message. qos: of a publisher of its topic."""
        topic = message.topic
        if topic not in self._channels:
            schema = self._writer.register_schema(message.type, "ros2msg", definition(message.type).encode())
            offered = {
                "reliability": RELIABILITIES.index(qos.get("reliability", "reliable")),
                "durability": DURABILITIES.index(qos.get("durability", "volatile")),
            }
            metadata = {QOS: yaml.safe_dump([offered])}
            self._channels[topic] = self._writer.register_channel(topic, "cdr", schema, metadata)
            self._types[topic] = message.type
        received, sent = (self._epoch + round(moment * SECOND) for moment in (message.stamp, message.sent))
        self._span = [min([received, *self._span]), max([received, *self._span])]
        self._writer.add_message(self._channels[topic], received, message.raw, sent, self.counts.total())
        self.counts[topic] += 1

    def _metadata(self) -> dict[str, Any]:
        begin, end = self._span or (0, 0)
        span = {
            "duration": {"nanoseconds": end - begin},
            "starting_time": {"nanoseconds_since_epoch": begin},
            "message_count": self.counts.total(),
        }
        topics = [
            {
                "topic_metadata": {
                    "name": name,
                    "type": self._types[name],
                    "serialization_format": "cdr",
                    QOS: "",
                    "type_description_hash": "",
                },
                "message_count": count,
            }
            for name, count in sorted(self.counts.items())
        ]
        return {
            "rosbag2_bagfile_information": {
                "version": VERSION,
                "storage_identifier": "mcap",
                **span,
                "topics_with_message_count": topics,
                "compression_format": "",
                "compression_mode": "",
                "relative_file_paths": [self.file.name],
                "files": [{"path": self.file.name, **span}],
                "custom_data": None,
                "ros_distro": DISTRO,
            }
        }


@dataclass(frozen=True)
class Bag:
    """Reads a bag: a folder, or one MCAP file. Raises CliError if it is none."""

    path: Path

    @property
    def files(self) -> list[Path]:
        """Its MCAP files, in order."""
        found = sorted(self.path.glob("*.mcap")) if self.path.is_dir() else [self.path]
        if not found or not found[0].is_file():
            what = "has no .mcap file" if self.path.is_dir() else "is not there"
            raise CliError(f"Bag path '{self.path}' {what}.")
        return found

    def messages(self) -> Iterator[tuple[Schema, Channel, Any]]:
        """Schema, channel and message, in the order in which they were recorded."""
        for file in self.files:
            try:
                with file.open("rb") as stream:
                    yield from make_reader(stream).iter_messages()
            except CliError:
                raise
            except Exception as error:  # the library raises many kinds of errors for a damaged file
                raise CliError(f"{file} is not an MCAP file, or it is damaged ({error}).") from None

    def info(self) -> str:
        """A summary, as `ros2 bag info` prints it."""
        counts: Counter[tuple[str, str]] = Counter()
        span: list[int] = []
        for schema, channel, message in self.messages():
            counts[channel.topic, schema.name] += 1
            span = [min([message.log_time, *span]), max([message.log_time, *span])]
        begin, end = span or (0, 0)
        topics = [
            f"Topic: {topic} | Type: {type_} | Count: {count} | Serialization Format: cdr"
            for (topic, type_), count in sorted(counts.items())
        ]
        rows = {
            "Files": ("\n" + 19 * " ").join(file.name for file in self.files),
            "Bag size": _size(sum(file.stat().st_size for file in self.files)),
            "Storage id": "mcap",
            "ROS Distro": DISTRO,
            "Duration": f"{_seconds(end - begin)}s",
            "Start": _date(begin),
            "End": _date(end),
            "Messages": counts.total(),
            "Topic information": ("\n" + 19 * " ").join(topics),
            "Service": 0,
        }
        lines = [f"{name + ':':19}{value}" for name, value in rows.items()]
        return "\n".join(["", *lines, "Service information: "])


def _seconds(nanoseconds: int) -> str:
    return f"{nanoseconds // SECOND}.{nanoseconds % SECOND:09}"


def _date(nanoseconds: int) -> str:
    local = time.localtime(nanoseconds // SECOND)
    clock = time.strftime("%b %e %Y %H:%M:%S", local)
    return f"{clock}.{nanoseconds % SECOND:09} ({_seconds(nanoseconds)})"


def _size(number: float) -> str:
    units = ["B", "KiB", "MiB", "GiB"]
    while number >= 1024 and len(units) > 1:
        number /= 1024
        del units[0]
    return f"{number:.0f} B" if units[0] == "B" else f"{number:.1f} {units[0]}"
