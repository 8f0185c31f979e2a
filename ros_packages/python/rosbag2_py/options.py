"""How a bag is opened: where it is, what is read of it, and in which order."""

from __future__ import annotations

import enum
import re
from dataclasses import dataclass, field
from pathlib import Path

STORAGE = "mcap"
FORMAT = "cdr"
SQLITE = (
    "{0} is a bag in SQLite's format, and only bags in 'mcap' can be read here. Convert it where ROS is "
    "installed: `ros2 bag convert -i {0} -o out.yaml`, with `output_bags: [{{uri: new_bag, storage_id: mcap, "
    "all: true}}]` in out.yaml."
)


@dataclass
class StorageOptions:
    """A bag's location, and when a new file of it begins: after so many bytes or seconds, or never with 0."""

    uri: str
    storage_id: str = ""
    max_bagfile_size: int = 0
    max_bagfile_duration: int = 0
    max_cache_size: int = 0
    storage_preset_profile: str = ""
    storage_config_uri: str = ""
    snapshot_mode: bool = False
    start_time_ns: int = -1
    end_time_ns: int = -1
    custom_data: dict[str, str] = field(default_factory=dict)


@dataclass
class ConverterOptions:
    """The serialization formats of what is read or written; "" for that of the bag."""

    input_serialization_format: str = ""
    output_serialization_format: str = ""


@dataclass
class StorageFilter:
    """A filter of topics to read: those that are named or match `regex`, without those that are excluded."""

    topics: list[str] = field(default_factory=list)
    services_events: list[str] = field(default_factory=list)
    regex: str = ""
    exclude_topics: list[str] = field(default_factory=list)
    exclude_service_events: list[str] = field(default_factory=list)
    regex_to_exclude: str = ""

    def selects(self, topic: str) -> bool:
        """Return whether a topic is read."""
        named = (*self.topics, *self.services_events)
        wanted = topic in named or (self.regex and re.fullmatch(self.regex, topic))
        if (named or self.regex) and not wanted:
            return False
        excluded = topic in (*self.exclude_topics, *self.exclude_service_events)
        return not (excluded or (self.regex_to_exclude and re.fullmatch(self.regex_to_exclude, topic)))


class ReadOrderSortBy(enum.IntEnum):
    """The criterion by which messages are sorted."""

    ReceivedTimestamp = 0
    PublishedTimestamp = 1
    File = 2


@dataclass
class ReadOrder:
    """The order in which messages are read."""

    sort_by: ReadOrderSortBy = ReadOrderSortBy.ReceivedTimestamp
    reverse: bool = False


def get_default_storage_id() -> str:
    """The storage of a bag for which none is given."""
    return STORAGE


def get_registered_readers() -> set[str]:
    """The storages that can be read."""
    return {STORAGE}


def get_registered_writers() -> set[str]:
    """The storages that can be written."""
    return {STORAGE}


def get_registered_serializers() -> set[str]:
    """The formats that messages can be converted to: none."""
    return set()


def check_storage(options: StorageOptions, converter: ConverterOptions) -> None:
    """Raise RuntimeError unless the storage and the formats are those that there are here."""
    if options.storage_id not in ("", STORAGE):
        raise RuntimeError(
            f"No storage could be initialized: storage_id is '{options.storage_id}', and only '{STORAGE}' is "
            f"supported here. Pass storage_id='{STORAGE}'."
        )
    for requested in (converter.input_serialization_format, converter.output_serialization_format):
        if requested not in ("", FORMAT):
            raise RuntimeError(f"Messages are '{FORMAT}', and can't be converted to or from '{requested}'.")


def check_file_format(uri: Path) -> None:
    """Raise RuntimeError if a bag is one of SQLite's files, or a folder of them."""
    if uri.suffix == ".db3" or any(uri.glob("*.db3")):
        raise RuntimeError(SQLITE.format(uri))
