"""Transforms between frames, in pure Python, with the names of upstream's tf2_ros.

It lacks BufferClient, which looks up transforms in another process.
"""

import importlib
from typing import Any

from tf2_py import (
    BufferCore,
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)

from tf2_ros.buffer import Buffer
from tf2_ros.buffer_interface import (
    BufferInterface,
    ConvertRegistration,
    NotImplementedException,
    Stamped,
    TransformRegistration,
    TypeException,
    convert,
)
from tf2_ros.static_transform_broadcaster import StaticTransformBroadcaster
from tf2_ros.transform_broadcaster import TransformBroadcaster
from tf2_ros.transform_listener import DEFAULT_STATIC_TF_TOPIC, DEFAULT_TF_TOPIC, TransformListener

# Names that upstream's modules import, and that `from tf2_ros import ...` finds there, too.
IMPORTED_UPSTREAM = {
    "geometry_msgs.msg": (
        *("PointStamped", "PoseStamped", "PoseWithCovarianceStamped", "TransformStamped", "Vector3Stamped"),
    ),
    "rclpy.action.client": ("ActionClient",),
    "rclpy.callback_groups": ("ReentrantCallbackGroup",),
    "rclpy.clock": ("Clock", "JumpThreshold", "TimeJump"),
    "rclpy.duration": ("Duration",),
    "rclpy.executors": ("SingleThreadedExecutor",),
    "rclpy.node": ("Node",),
    "rclpy.qos": ("DurabilityPolicy", "HistoryPolicy", "QoSProfile"),
    "rclpy.task": ("Future",),
    "rclpy.time": ("Time",),
    "sensor_msgs.msg": ("PointCloud2",),
    "std_msgs.msg": ("Header",),
    "tf2_msgs.action": ("LookupTransform",),
    "tf2_msgs.msg": ("TFMessage",),
    "tf2_msgs.srv": ("FrameGraph",),
    "threading": ("Thread",),
    "copy": ("deepcopy",),
    "time": ("sleep",),
}
_HOMES = {name: module for module, names in IMPORTED_UPSTREAM.items() for name in names}
_MODULES = {"rclpy": "rclpy", "tf2": "tf2_py", "threading": "threading", "warnings": "warnings"}

__all__ = [
    "DEFAULT_STATIC_TF_TOPIC",
    "DEFAULT_TF_TOPIC",
    "Buffer",
    "BufferCore",
    "BufferInterface",
    "ConnectivityException",
    "ConvertRegistration",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "NotImplementedException",
    "Stamped",
    "StaticTransformBroadcaster",
    "TimeoutException",
    "TransformBroadcaster",
    "TransformException",
    "TransformListener",
    "TransformRegistration",
    "TypeException",
    "convert",
    *_HOMES,
    *_MODULES,
]


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        return getattr(importlib.import_module(_HOMES[name]), name)
    if name in _MODULES:
        return importlib.import_module(_MODULES[name])
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
