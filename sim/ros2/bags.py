"""Bags: folders of recorded messages in MCAP files, as `ros2 bag` writes and reads them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml
from mcap.reader import make_reader
from mcap.records import Channel, Schema
from mcap.writer import Writer
from rosbag2_py.options import check_file_format

from sim.nanoseconds import SECOND, Nanoseconds
from sim.ros.messages.type_definitions import definition
from sim.ros2.bag_metadata import Contents
from sim.ros2.system import CliError, ReceivedMessage

RELIABILITIES, DURABILITIES = ("", "reliable", "best_effort"), ("", "transient_local", "volatile")
QOS = "offered_qos_profiles"  # key in a channel's metadata


class BagWriter:
    """Writes one bag; a context manager. Raises CliError if the folder exists or can't be created.

    epoch: as `System.epoch`.
    """

    def __init__(self, folder: Path, epoch: Nanoseconds = 0) -> None:
        self.folder, self.file = folder, folder / f"{folder.name}_0.mcap"
        try:
            folder.mkdir(parents=True)
        except FileExistsError:
            raise CliError(f"Output folder '{folder}' already exists.") from None
        except OSError as error:
            raise CliError(f"Output folder '{folder}' can't be made: {error.strerror}.") from None
        self._writer, self._epoch = Writer(str(self.file)), epoch
        self._channels: dict[str, int] = {}
        self.contents = Contents()

    def __enter__(self) -> BagWriter:
        self._writer.start("ros2", "ros2-notebook-course")
        return self

    def __exit__(self, *exception: object) -> None:
        self._writer.finish()
        write_metadata(self.folder, self.contents, [self.file])

    def write(self, message: ReceivedMessage, qos: dict[str, Any]) -> None:
        """Add a message. qos: of a publisher of its topic."""
        offered = {
            "reliability": RELIABILITIES.index(qos.get("reliability", "reliable")),
            "durability": DURABILITIES.index(qos.get("durability", "volatile")),
        }
        received, sent = (self._epoch + round(moment * SECOND) for moment in (message.stamp, message.sent))
        metadata = {QOS: yaml.safe_dump([offered])}
        self.add(message.topic, message.type, message.raw, (received, sent), metadata)

    def add(
        self, topic: str, type_: str, raw: bytes, times: tuple[int, int], metadata: dict[str, str]
    ) -> None:
        """Add a message's bytes. times: when it was received and sent. metadata: of its topic's channel."""
        if topic not in self._channels:
            schema = self._writer.register_schema(type_, "ros2msg", definition(type_).encode())
            self._channels[topic] = self._writer.register_channel(topic, "cdr", schema, metadata)
        self._writer.add_message(self._channels[topic], times[0], raw, times[1], self.contents.counts.total())
        self.contents.add(topic, type_, times[0])


def write_metadata(folder: Path, contents: Contents, files: list[Path]) -> None:
    """Write the metadata.yaml of a bag."""
    text = yaml.safe_dump(contents.metadata(files), sort_keys=False)
    (folder / "metadata.yaml").write_text(text)


@dataclass(frozen=True)
class Bag:
    """Reads a bag: a folder, or one MCAP file. Raises CliError if it is none."""

    path: Path

    @property
    def files(self) -> list[Path]:
        """Its MCAP files, in order."""
        try:
            check_file_format(self.path)
        except RuntimeError as error:
            raise CliError(str(error)) from None
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

    @property
    def contents(self) -> Contents:
        """Return what is in it."""
        found = Contents()
        for schema, channel, message in self.messages():
            found.add(channel.topic, schema.name, message.log_time)
        return found

    def info(self) -> str:
        """A summary, as `ros2 bag info` prints it."""
        return self.contents.info(self.files)
