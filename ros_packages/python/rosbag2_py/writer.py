"""Writes messages into a new bag."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path

from mcap.writer import Writer
from rclpy.utilities import get_default_context

from rosbag2_py.definitions import message_definition
from rosbag2_py.metadata import (
    BagMetadata,
    FileInformation,
    MetadataIo,
    TopicInformation,
    TopicMetadata,
    system_time,
)
from rosbag2_py.options import STORAGE, ConverterOptions, StorageOptions, check_storage

NOT_OPEN = "Bag is not open. Call open() before {}."
SECOND = 1_000_000_000


class SequentialWriter:
    """Writes a bag: a folder of MCAP files and metadata.yaml. Errors are RuntimeError, as upstream's.

    It is closed when it is deleted, and when rclpy is shut down.
    """

    def __init__(self) -> None:
        self._file: _File | None = None
        self._options = StorageOptions("")
        self._folder = Path()
        self._topics: dict[str, TopicInformation] = {}
        self._files: list[FileInformation] = []

    def open(self, storage_options: StorageOptions, converter_options: ConverterOptions) -> None:
        """Make the bag's folder and its first file."""
        if self._file is not None:
            return
        check_storage(storage_options, converter_options)
        if storage_options.snapshot_mode:
            raise RuntimeError("Snapshot mode is not supported here: write all messages.")
        self._options, self._folder = storage_options, Path(storage_options.uri)
        if self._folder.is_dir():
            raise RuntimeError(f"Bag directory already exists ({self._folder}), can't overwrite existing bag")
        try:
            self._folder.mkdir(parents=True)
        except OSError:
            raise RuntimeError(f"Failed to create bag directory ({self._folder}).") from None
        self._begin_file()
        context = get_default_context()
        if context.ok():
            context.on_shutdown(self.close)

    def create_topic(self, topic_with_type: TopicMetadata) -> None:
        """Add a topic, before its first message is written."""
        if topic_with_type.name in self._topics:
            return
        self._check_open("writing")
        self._topics[topic_with_type.name] = TopicInformation(topic_with_type, 0)

    def remove_topic(self, topic_with_type: TopicMetadata) -> None:
        """Remove a topic without messages."""
        self._check_open("removing")
        if self._topics.pop(topic_with_type.name, None) is None:
            raise RuntimeError(f'Failed to remove the non-existing topic "{topic_with_type.name}"!')

    def write(
        self, topic_name: str, message: bytes, recv_timestamp: int, send_timestamp: int | None = None
    ) -> None:
        """Write a serialized message, with the moments of its reception and publication in nanoseconds."""
        file = self._check_open("writing")
        first, last = self._options.start_time_ns, self._options.end_time_ns
        if recv_timestamp < first or 0 <= last < recv_timestamp:
            return
        topic = self._topics.get(topic_name)
        if topic is None:
            raise RuntimeError(
                f"Failed to write on topic '{topic_name}'. Call create_topic() before first write."
            )
        if file.is_full(self._options, recv_timestamp):
            self.split_bagfile()
            file = self._check_open("writing")
        sent = recv_timestamp if send_timestamp is None else send_timestamp
        file.write(topic.topic_metadata, message, recv_timestamp, sent)
        topic.message_count += 1

    def split_bagfile(self) -> None:
        """Begin the bag's next file."""
        self._end_file(self._check_open("writing"))
        self._begin_file()

    def take_snapshot(self) -> bool:
        """Write what snapshot mode has stored: nothing, because there is no such mode here."""
        return False

    def close(self) -> None:
        """Finish the bag."""
        if self._file is None:
            return
        self._end_file(self._file)
        self._file = None
        filled = [each for each in self._files if each.message_count] or self._files[:1]
        begin = min(each.starting_time for each in filled)
        end = max(each.starting_time + each.duration for each in filled)
        metadata = BagMetadata(
            storage_identifier=STORAGE,
            relative_file_paths=[each.path for each in self._files],
            files=self._files,
            starting_time=begin,
            duration=end - begin,
            message_count=sum(each.message_count for each in self._files),
            topics_with_message_count=list(self._topics.values()),
            custom_data=self._options.custom_data,
            ros_distro=os.environ.get("ROS_DISTRO", ""),
        )
        MetadataIo().write_metadata(str(self._folder), metadata)

    def __del__(self) -> None:
        with contextlib.suppress(OSError):  # its folder may be gone
            if hasattr(self, "_files"):
                self.close()

    def _check_open(self, what: str) -> _File:
        if self._file is None:
            raise RuntimeError(NOT_OPEN.format(what))
        return self._file

    def _begin_file(self) -> None:
        self._file = _File(self._folder / f"{self._folder.name}_{len(self._files)}.mcap")

    def _end_file(self, file: _File) -> None:
        file.finish()
        begin, end = file.span or (0, 0)
        duration = system_time(end) - system_time(begin)
        self._files.append(FileInformation(file.path.name, system_time(begin), duration, file.count))


class _File:
    """One MCAP file of a bag."""

    def __init__(self, path: Path) -> None:
        self.path, self.count = path, 0
        self.span: tuple[int, int] | None = None
        self._bytes = 0
        self._channels: dict[str, int] = {}
        self._writer = Writer(str(path))
        self._writer.start("ros2", "rosbag2_py")

    def is_full(self, options: StorageOptions, moment: int) -> bool:
        """Return whether the options require a new file for a message at this moment."""
        long = options.max_bagfile_duration * SECOND
        begun = self.span is not None and long and moment - self.span[0] > long
        return bool(begun) or 0 < options.max_bagfile_size <= self._bytes

    def write(self, topic: TopicMetadata, message: bytes, received: int, sent: int) -> None:
        """Add a message."""
        if topic.name not in self._channels:
            text = message_definition(topic.type).encode()
            schema = self._writer.register_schema(topic.type, "ros2msg" if text else "", text)
            self._channels[topic.name] = self._writer.register_channel(
                topic.name, topic.serialization_format, schema
            )
        self._writer.add_message(self._channels[topic.name], received, message, sent, self.count)
        begin, end = self.span or (received, received)
        self.span = min(begin, received), max(end, received)
        self.count, self._bytes = self.count + 1, self._bytes + len(message)

    def finish(self) -> None:
        """Write what belongs at the end of the file."""
        self._writer.finish()
