"""Reads the messages of a bag, one after the other."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mcap.exceptions import McapError
from mcap.reader import make_reader
from mcap.records import Channel, Message, Schema

from rosbag2_py.metadata import (
    BagMetadata,
    FileInformation,
    MessageDefinition,
    MetadataIo,
    TopicInformation,
    TopicMetadata,
    system_time,
)
from rosbag2_py.options import (
    STORAGE,
    ConverterOptions,
    ReadOrder,
    ReadOrderSortBy,
    StorageFilter,
    StorageOptions,
    check_file_format,
    check_storage,
)

NOT_OPEN = "Bag is not open. Call open() before {}."


class SequentialReader:
    """Reads a bag: a folder with metadata.yaml, or one MCAP file. Errors are RuntimeError, as upstream's."""

    def __init__(self) -> None:
        self._files: list[Path] = []
        self._metadata = BagMetadata()
        self._filter, self._order = StorageFilter(), ReadOrder()
        self._messages: Iterator[tuple[str, Message]] | None = None
        self._next: tuple[str, Message] | None = None

    def open(self, storage_options: StorageOptions, converter_options: ConverterOptions) -> None:
        """Open a bag at its first message."""
        uri = Path(storage_options.uri)
        check_file_format(uri)
        check_storage(storage_options, converter_options)
        if MetadataIo().metadata_file_exists(str(uri)):
            self._metadata = MetadataIo().read_metadata(str(uri))
            if self._metadata.storage_identifier != STORAGE:
                check_storage(StorageOptions("", self._metadata.storage_identifier), ConverterOptions())
            self._files = [uri / path for path in self._metadata.relative_file_paths]
        else:
            self._files = sorted(uri.glob("*.mcap")) if uri.is_dir() else [uri]
            if not self._files or not all(path.is_file() for path in self._files):
                raise RuntimeError("No storage could be initialized from the inputs.")
            self._metadata = _summarize(self._files)
        self._messages = self._iterate(None)

    def open_uri(self, uri: str) -> None:
        """Open a bag with default options."""
        self.open(StorageOptions(uri), ConverterOptions())

    def close(self) -> None:
        """Close the bag."""
        self._messages = self._next = None

    def set_read_order(self, order: ReadOrder) -> bool:
        """Set the order of the messages that follow; returns whether it is supported."""
        self._check_open("read order can only be set after open()")
        if order.sort_by == ReadOrderSortBy.PublishedTimestamp:
            return False
        if order.sort_by == ReadOrderSortBy.File and order.reverse:
            return False
        self._order, self._next = order, None
        self._messages = self._iterate(None)
        return True

    def has_next(self) -> bool:
        """Return whether there is one more message that the filter selects."""
        messages = self._check_open(NOT_OPEN.format("reading"))
        while self._next is None or not self._filter.selects(self._next[0]):
            self._next = next(messages, None)
            if self._next is None:
                return False
        return True

    def read_next(self) -> tuple[str, bytes, int]:
        """The topic, the serialized message and the moment of its reception in nanoseconds."""
        if not self.has_next() or self._next is None:
            raise RuntimeError("Bag is at end. No next message.")
        (topic, message), self._next = self._next, None
        return topic, message.data, message.log_time

    def get_metadata(self) -> BagMetadata:
        """Return what is known of the bag as a whole."""
        self._check_open(NOT_OPEN.format("reading"))
        return self._metadata

    def get_all_topics_and_types(self) -> list[TopicMetadata]:
        """The bag's topics."""
        self._check_open(NOT_OPEN.format("reading"))
        return [each.topic_metadata for each in self._metadata.topics_with_message_count]

    def get_all_message_definitions(self) -> list[MessageDefinition]:
        """The definitions of the types of the bag's topics."""
        self._check_open(NOT_OPEN.format("reading"))
        schemas = {each.name: each for path in self._files for each in _schemas(path)}
        return [
            MessageDefinition(each.name, each.encoding, each.data.decode(), "") for each in schemas.values()
        ]

    def set_filter(self, storage_filter: StorageFilter) -> None:
        """Select the topics of the messages that follow."""
        self._check_open(NOT_OPEN.format("setting filter"))
        self._filter = storage_filter

    def reset_filter(self) -> None:
        """Select all topics."""
        self.set_filter(StorageFilter())

    def seek(self, timestamp: int) -> None:
        """Go to the first message at this moment or later (with reverse order: earlier), in nanoseconds."""
        self._check_open(NOT_OPEN.format("seeking time"))
        self._next = None
        self._messages = self._iterate(timestamp)

    def _check_open(self, reason: str) -> Iterator[tuple[str, Message]]:
        if self._messages is None:
            raise RuntimeError(reason)
        return self._messages

    def _iterate(self, moment: int | None) -> Iterator[tuple[str, Message]]:
        """The messages in the present order; moment: where to begin, or None."""
        reverse = self._order.reverse
        limits: dict[str, int] = {}
        if moment is not None:
            limits = {"ending_at" if reverse else "starting_at": moment}
        sort = self._order.sort_by != ReadOrderSortBy.File
        for path in reversed(self._files) if reverse else self._files:
            for _, channel, message in _read(path, log_time_order=sort, reverse=reverse, **limits):
                yield channel.topic, message


def _read(path: Path, **options: Any) -> Iterator[tuple[Schema, Channel, Message]]:
    """The messages in a file. Raises RuntimeError."""
    try:
        with path.open("rb") as stream:
            yield from make_reader(stream).iter_messages(**options)
    except McapError as error:
        raise RuntimeError(f"{path} is not an MCAP file, or it is damaged: {error}") from None


def _schemas(path: Path) -> list[Schema]:
    with path.open("rb") as stream:
        summary = make_reader(stream).get_summary()
    return list(summary.schemas.values()) if summary is not None else []


def _summarize(files: list[Path]) -> BagMetadata:
    """The metadata of a bag without metadata.yaml."""
    counts: dict[tuple[str, str, str], int] = {}
    spans: list[FileInformation] = []
    for path in files:
        moments: list[int] = []
        for schema, channel, message in _read(path):
            key = channel.topic, schema.name, channel.message_encoding
            counts[key] = counts.get(key, 0) + 1
            moments.append(message.log_time)
        begin, end = (min(moments), max(moments)) if moments else (0, 0)
        spans.append(
            FileInformation(
                path.name, system_time(begin), system_time(end) - system_time(begin), len(moments)
            )
        )
    filled = [each for each in spans if each.message_count]
    begin = min((each.starting_time for each in filled), default=system_time(0))
    end = max((each.starting_time + each.duration for each in filled), default=system_time(0))
    return BagMetadata(
        bag_size=sum(path.stat().st_size for path in files),
        storage_identifier=STORAGE,
        relative_file_paths=[path.name for path in files],
        files=spans,
        starting_time=begin,
        duration=end - begin,
        message_count=sum(counts.values()),
        topics_with_message_count=[
            TopicInformation(TopicMetadata(number, *key), count)
            for number, (key, count) in enumerate(counts.items(), 1)
        ],
    )
