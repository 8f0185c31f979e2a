"""Reads and writes bags, with upstream's names. Their storage is MCAP, without compression.

It lacks what plays, records, converts, compresses and reindexes bags: `ros2 bag` plays and records them.
"""

from rosbag2_py._storage import (
    BagMetadata,
    ConverterOptions,
    FileInformation,
    MessageDefinition,
    MetadataIo,
    ReadOrder,
    ReadOrderSortBy,
    StorageFilter,
    StorageOptions,
    TopicInformation,
    TopicMetadata,
    get_default_storage_id,
)
from rosbag2_py.metadata import Info
from rosbag2_py.options import (
    get_registered_readers,
    get_registered_serializers,
    get_registered_writers,
)
from rosbag2_py.reader import SequentialReader
from rosbag2_py.writer import SequentialWriter

__all__ = [
    "BagMetadata",
    "ConverterOptions",
    "FileInformation",
    "Info",
    "MessageDefinition",
    "MetadataIo",
    "ReadOrder",
    "ReadOrderSortBy",
    "SequentialReader",
    "SequentialWriter",
    "StorageFilter",
    "StorageOptions",
    "TopicInformation",
    "TopicMetadata",
    "get_default_storage_id",
    "get_registered_readers",
    "get_registered_serializers",
    "get_registered_writers",
]
