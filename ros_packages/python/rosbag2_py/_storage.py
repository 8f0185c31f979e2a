"""Upstream's module of this name, which its tutorials use: options and metadata of a bag."""

from rosbag2_py.metadata import (
    BagMetadata,
    FileInformation,
    MessageDefinition,
    MetadataIo,
    TopicInformation,
    TopicMetadata,
)
from rosbag2_py.options import (
    ConverterOptions,
    ReadOrder,
    ReadOrderSortBy,
    StorageFilter,
    StorageOptions,
    get_default_storage_id,
)

__all__ = [
    "BagMetadata",
    "ConverterOptions",
    "FileInformation",
    "MessageDefinition",
    "MetadataIo",
    "ReadOrder",
    "ReadOrderSortBy",
    "StorageFilter",
    "StorageOptions",
    "TopicInformation",
    "TopicMetadata",
    "get_default_storage_id",
]
