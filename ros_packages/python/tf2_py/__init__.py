"""The buffer of transforms that tf2_ros uses, with the names of upstream's tf2_py."""

from tf2_py.buffer_core import BufferCore
from tf2_py.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)

__all__ = [
    "BufferCore",
    "ConnectivityException",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "TimeoutException",
    "TransformException",
]
