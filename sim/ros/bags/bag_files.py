"""Bags as files: folders of recorded messages, as `ros2 bag` writes and reads them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml
from mcap.reader import make_reader
from mcap.records import Channel, Schema
from mcap.writer import MCAP0_MAGIC, Writer

from sim.ros.bags.bag_error import BagError
from sim.ros.bags.contents import MCAP, SQLITE, Contents
from sim.ros.bags.qos import recorded_qos
from sim.ros.bags.sqlite import QOS, read_sqlite
from sim.ros.messages.type_definitions import definition

COMPRESSED = ".zstd"
SUFFIXES = {".mcap": MCAP, ".db3": SQLITE}


class BagWriter:
    """Writes one bag in MCAP; a context manager. Raises BagError if the folder exists or can't be created."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.file = folder, folder / f"{folder.name}_0.mcap"
        try:
            folder.mkdir(parents=True)
        except FileExistsError:
            raise BagError(f"Output folder '{folder}' already exists.") from None
        except OSError as error:
            raise BagError(f"Output folder '{folder}' can't be made: {error.strerror}.") from None
        self._writer = Writer(str(self.file))
        self._channels: dict[str, int] = {}
        self.contents = Contents()

    def __enter__(self) -> BagWriter:
        self._writer.start("ros2", "ros2-notebook-course")
        return self

    def __exit__(self, *exception: object) -> None:
        self._writer.finish()
        write_metadata(self.folder, self.contents, [self.file])

    def write(self, topic: str, type_: str, raw: bytes, times: tuple[int, int], qos: dict[str, Any]) -> None:
        """Add a message's bytes. times: when it was received and sent. qos: of a publisher of its topic."""
        self.add(topic, type_, raw, times, {QOS: yaml.safe_dump([recorded_qos(qos)])})

    def add(
        self, topic: str, type_: str, raw: bytes, times: tuple[int, int], metadata: dict[str, str]
    ) -> None:
        """Add a message's bytes. times: when it was received and sent. metadata: of its topic's channel."""
        if topic not in self._channels:
            schema = self._writer.register_schema(type_, "ros2msg", definition(type_).encode())
            self._channels[topic] = self._writer.register_channel(topic, "cdr", schema, metadata)
        self._writer.add_message(self._channels[topic], times[0], raw, times[1], self.contents.counts.total())
        self.contents.add(topic, type_, times[0], metadata.get(QOS, ""))


def write_metadata(folder: Path, contents: Contents, files: list[Path]) -> None:
    """Write the metadata.yaml of a bag."""
    text = yaml.safe_dump(contents.metadata(files), sort_keys=False)
    (folder / "metadata.yaml").write_text(text)


@dataclass(frozen=True)
class Bag:
    """Reads a bag: a folder, or one file, in MCAP or in SQLite's format. Raises BagError if it is none."""

    path: Path

    @property
    def files(self) -> list[Path]:
        """Its files, in order."""
        suffixes = SUFFIXES if self.path.is_dir() else ()
        found = [path for suffix in suffixes for path in sorted(self.path.glob(f"*{suffix}"))]
        found = found if self.path.is_dir() else [self.path]
        if not found and any(self.path.glob(f"*{COMPRESSED}")):
            raise BagError(
                f"Bag path '{self.path}' has compressed files. Decompress them first: `unzstd *{COMPRESSED}` "
                "in that folder."
            )
        if not found or not found[0].is_file():
            what = "has no .mcap and no .db3 file" if self.path.is_dir() else "is not there"
            raise BagError(f"Bag path '{self.path}' {what}.")
        return found

    @property
    def storage(self) -> str:
        """Its format, "mcap" or "sqlite3"."""
        return SUFFIXES.get(self.files[0].suffix, MCAP)

    def messages(self) -> Iterator[tuple[Schema, Channel, Any]]:
        """Schema, channel and message, in the order in which they were recorded."""
        for file in self.files:
            if file.suffix == ".db3":
                yield from read_sqlite(file)
            else:
                yield from _read_mcap(file)

    @property
    def contents(self) -> Contents:
        """Return what is in it."""
        found = Contents()
        for schema, channel, message in self.messages():
            found.add(channel.topic, schema.name, message.log_time, channel.metadata.get(QOS, ""))
        return found

    def info(self) -> str:
        """A summary, as `ros2 bag info` prints it."""
        return self.contents.info(self.files, self.storage)


def _read_mcap(file: Path) -> Iterator[tuple[Schema, Channel, Any]]:
    try:
        with file.open("rb") as stream:
            for schema, channel, message in make_reader(stream).iter_messages():
                if schema is not None:
                    yield schema, channel, message
    except BagError:
        raise
    except Exception as error:  # the library raises many kinds of errors for a damaged file
        raise BagError(_damage(file, error)) from None


def _damage(file: Path, error: Exception) -> str:
    """A sentence on why a file can't be read. MCAP begins and ends with the same bytes."""
    try:
        content = file.read_bytes()
    except OSError as failure:
        return f"{file} can't be read: {failure.strerror}."
    if content.startswith(MCAP0_MAGIC) and not content.endswith(MCAP0_MAGIC):
        return (
            f"{file} ends in the middle: its recorder was killed, or it was copied in part. Copy it again, "
            f"or repair it with `mcap recover {file.name}`."
        )
    return f"{file} is not an MCAP file, or it is damaged ({error})."
