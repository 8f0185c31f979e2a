"""What is known of a bag as a whole: its files, topics and times, in metadata.yaml."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import yaml
from rclpy.clock import ClockType
from rclpy.duration import Duration
from rclpy.time import Time

METADATA_FILE = "metadata.yaml"
VERSION = 9
ROOT = "rosbag2_bagfile_information"


@dataclass
class TopicMetadata:
    """A topic of a bag."""

    id: int
    name: str
    type: str
    serialization_format: str
    offered_qos_profiles: list[Any] = field(default_factory=list)
    type_description_hash: str = ""

    def equals(self, other: TopicMetadata) -> bool:
        """Return whether both are the same topic with the same type and format."""
        return self == other


@dataclass
class TopicInformation:
    """A topic of a bag, with the number of its messages."""

    topic_metadata: TopicMetadata
    message_count: int


@dataclass
class MessageDefinition:
    """The definition of a message type in a bag."""

    topic_type: str
    encoding: str
    encoded_message_definition: str
    type_hash: str


@dataclass
class FileInformation:
    """A file of a bag."""

    path: str
    starting_time: Time
    duration: Duration
    message_count: int


def system_time(nanoseconds: int) -> Time:
    """A moment in a bag."""
    return Time(nanoseconds=nanoseconds, clock_type=ClockType.SYSTEM_TIME)


@dataclass
class BagMetadata:
    """The contents of metadata.yaml."""

    version: int = VERSION
    bag_size: int = 0
    storage_identifier: str = ""
    relative_file_paths: list[str] = field(default_factory=list)
    files: list[FileInformation] = field(default_factory=list)
    duration: Duration = field(default_factory=Duration)
    starting_time: Time = field(default_factory=lambda: system_time(0))
    message_count: int = 0
    topics_with_message_count: list[TopicInformation] = field(default_factory=list)
    compression_format: str = ""
    compression_mode: str = ""
    custom_data: dict[str, str] = field(default_factory=dict)
    ros_distro: str = ""


class MetadataIo:
    """Reads and writes metadata.yaml."""

    def metadata_file_exists(self, uri: str) -> bool:
        """Return whether a bag's folder has it."""
        return Path(uri, METADATA_FILE).is_file()

    def read_metadata(self, uri: str) -> BagMetadata:
        """Read it from a bag's folder. Raises RuntimeError."""
        try:
            text = Path(uri, METADATA_FILE).read_text(encoding="utf-8")
        except OSError as error:
            raise RuntimeError(f"Exception on parsing info file: {error.strerror}") from None
        metadata = self.deserialize_metadata(text)
        metadata.bag_size = sum(path.stat().st_size for path in Path(uri).iterdir() if path.is_file())
        return metadata

    def write_metadata(self, uri: str, metadata: BagMetadata) -> None:
        """Write it into a bag's folder."""
        text = yaml.safe_dump({ROOT: _encode(metadata)}, sort_keys=False)
        Path(uri, METADATA_FILE).write_text(text, encoding="utf-8")

    def serialize_metadata(self, metadata: BagMetadata) -> str:
        """The metadata as YAML."""
        return yaml.safe_dump(_encode(metadata), sort_keys=False)

    def deserialize_metadata(self, text: str) -> BagMetadata:
        """The metadata in YAML. Raises RuntimeError."""
        try:
            values = yaml.safe_load(text)
            return _decode(values.get(ROOT, values))
        except (yaml.YAMLError, AttributeError, KeyError, TypeError) as error:
            raise RuntimeError(f"Exception on parsing info file: {error}") from None


class Info:
    """Reads a bag's metadata."""

    def read_metadata(self, uri: str, storage_id: str) -> BagMetadata:
        """The metadata of the bag in a folder. Raises RuntimeError."""
        return MetadataIo().read_metadata(uri)


def _span(starting_time: Time, duration: Duration, count: int) -> dict[str, Any]:
    return {
        "duration": {"nanoseconds": duration.nanoseconds},
        "starting_time": {"nanoseconds_since_epoch": starting_time.nanoseconds},
        "message_count": count,
    }


def _encode(metadata: BagMetadata) -> dict[str, Any]:
    topics = [
        {
            "topic_metadata": {
                "name": each.topic_metadata.name,
                "type": each.topic_metadata.type,
                "serialization_format": each.topic_metadata.serialization_format,
                "offered_qos_profiles": each.topic_metadata.offered_qos_profiles,
                "type_description_hash": each.topic_metadata.type_description_hash,
            },
            "message_count": each.message_count,
        }
        for each in metadata.topics_with_message_count
    ]
    files = [
        {"path": each.path, **_span(each.starting_time, each.duration, each.message_count)}
        for each in metadata.files
    ]
    return {
        "version": metadata.version,
        "storage_identifier": metadata.storage_identifier,
        **_span(metadata.starting_time, metadata.duration, metadata.message_count),
        "topics_with_message_count": topics,
        "compression_format": metadata.compression_format,
        "compression_mode": metadata.compression_mode,
        "relative_file_paths": metadata.relative_file_paths,
        "files": files,
        "custom_data": metadata.custom_data or None,
        "ros_distro": metadata.ros_distro,
    }


def _times(values: dict[str, Any]) -> tuple[Time, Duration]:
    start = values["starting_time"]["nanoseconds_since_epoch"]
    return system_time(start), Duration(nanoseconds=values["duration"]["nanoseconds"])


def _decode(values: dict[str, Any]) -> BagMetadata:
    start, duration = _times(values)
    topics = []
    for number, each in enumerate(values["topics_with_message_count"], 1):
        topic = each["topic_metadata"]
        described = TopicMetadata(
            number,
            topic["name"],
            topic["type"],
            topic["serialization_format"],
            topic.get("offered_qos_profiles") or [],
            topic.get("type_description_hash", ""),
        )
        topics.append(TopicInformation(described, each["message_count"]))
    files = [
        FileInformation(each["path"], *_times(each), each["message_count"])
        for each in values.get("files", [])
    ]
    return BagMetadata(
        version=values["version"],
        storage_identifier=values["storage_identifier"],
        relative_file_paths=values["relative_file_paths"],
        files=files,
        duration=duration,
        starting_time=start,
        message_count=values["message_count"],
        topics_with_message_count=topics,
        compression_format=values.get("compression_format", ""),
        compression_mode=values.get("compression_mode", ""),
        custom_data=values.get("custom_data") or {},
        ros_distro=values.get("ros_distro", ""),
    )
