"""Canonical bytes: equal messages give equal bytes, and they mean what the message meant."""

import array
import random
import string

import numpy as np
import pytest
from rosidl_parser.definition import (
    AbstractGenericString,
    AbstractSequence,
    AbstractWString,
    Array,
    BasicType,
    BoundedSequence,
    NamespacedType,
)

from sim.ros.messages.cdr import canonical, is_canonical
from sim.ros.messages.codec import encode, message_class, type_name
from sim.ros.messages.decoder import decode

TYPES = [
    "std_msgs/msg/Bool", "std_msgs/msg/Byte", "std_msgs/msg/Char", "std_msgs/msg/String",
    "std_msgs/msg/Empty", "std_msgs/msg/Float32", "std_msgs/msg/Float64", "std_msgs/msg/Int8",
    "std_msgs/msg/UInt16", "std_msgs/msg/Int32", "std_msgs/msg/Int64", "std_msgs/msg/UInt64",
    "std_msgs/msg/Header", "std_msgs/msg/ColorRGBA", "std_msgs/msg/Float64MultiArray",
    "std_msgs/msg/UInt8MultiArray", "std_msgs/msg/Int16MultiArray", "builtin_interfaces/msg/Time",
    "geometry_msgs/msg/Twist", "geometry_msgs/msg/PoseWithCovarianceStamped",
    "geometry_msgs/msg/PolygonStamped", "geometry_msgs/msg/TransformStamped", "tf2_msgs/msg/TFMessage",
    "sensor_msgs/msg/LaserScan", "sensor_msgs/msg/Imu", "sensor_msgs/msg/JointState",
    "sensor_msgs/msg/Image", "sensor_msgs/msg/PointCloud2", "sensor_msgs/msg/NavSatFix",
    "sensor_msgs/msg/BatteryState", "sensor_msgs/msg/Joy", "sensor_msgs/msg/CameraInfo",
    "sensor_msgs/msg/MultiDOFJointState", "nav_msgs/msg/Odometry", "nav_msgs/msg/Path",
    "nav_msgs/msg/OccupancyGrid", "nav_msgs/msg/GridCells", "diagnostic_msgs/msg/DiagnosticArray",
    "trajectory_msgs/msg/JointTrajectory", "visualization_msgs/msg/MarkerArray",
    "visualization_msgs/msg/InteractiveMarkerUpdate", "shape_msgs/msg/SolidPrimitive",
    "shape_msgs/msg/Mesh", "rcl_interfaces/msg/ParameterEvent", "rcl_interfaces/msg/Log",
    "rcl_interfaces/msg/ParameterDescriptor", "action_msgs/msg/GoalStatusArray",
    "stereo_msgs/msg/DisparityImage", "rosgraph_msgs/msg/Clock",
    "control_msgs/msg/JointTrajectoryControllerState", "lifecycle_msgs/msg/TransitionEvent",
]  # fmt: skip
INTEGERS = {
    "octet": (0, 255), "char": (0, 255), "uint8": (0, 255), "int8": (-128, 127),
    "int16": (-(2**15), 2**15 - 1), "uint16": (0, 2**16 - 1), "int32": (-(2**31), 2**31 - 1),
    "uint32": (0, 2**32 - 1), "int64": (-(2**63), 2**63 - 1), "uint64": (0, 2**64 - 1),
}  # fmt: skip
# They have booleans, single bytes or bounded parts, or are empty.
FOUND_BY_VALUES = {
    "std_msgs/msg/Bool", "std_msgs/msg/Byte", "std_msgs/msg/Empty", "sensor_msgs/msg/PointCloud2",
    "sensor_msgs/msg/BatteryState", "sensor_msgs/msg/CameraInfo", "diagnostic_msgs/msg/DiagnosticArray",
    "visualization_msgs/msg/MarkerArray", "visualization_msgs/msg/InteractiveMarkerUpdate",
    "shape_msgs/msg/SolidPrimitive", "rcl_interfaces/msg/ParameterEvent",
    "rcl_interfaces/msg/ParameterDescriptor", "stereo_msgs/msg/DisparityImage",
}  # fmt: skip
ROUNDS = 12


def chosen(chance, slot):
    """A value by chance that fits a field."""
    if isinstance(slot, NamespacedType):
        return filled(chance, message_class("/".join((*slot.namespaces, slot.name))))
    if isinstance(slot, AbstractGenericString | AbstractWString):
        return "".join(chance.choices(string.printable + "äß€", k=chance.randrange(12)))
    if isinstance(slot, Array | AbstractSequence):
        most = min(slot.maximum_size, 5) if isinstance(slot, BoundedSequence) else 5
        size = slot.size if isinstance(slot, Array) else chance.randrange(most + 1)
        return [chosen(chance, slot.value_type) for _ in range(size)]
    assert isinstance(slot, BasicType)
    if slot.typename == "boolean":
        return chance.random() < 0.5
    if slot.typename in ("float", "double"):
        number = chance.choice((0.0, chance.uniform(-1e6, 1e6), 1e-9, float("inf")))
        return float(np.float32(number)) if slot.typename == "float" else number
    number = chance.randint(*INTEGERS[slot.typename])
    return bytes([number]) if slot.typename == "octet" else number


def filled(chance, cls):
    """A message with values by chance in all fields."""
    message = cls()
    for name, slot in zip(cls.get_fields_and_field_types(), cls.SLOT_TYPES, strict=True):
        setattr(message, name, chosen(chance, slot))
    return message


@pytest.mark.parametrize("name", TYPES)
def test_canonical_bytes_mean_the_same(name):
    chance = random.Random(name)
    for _ in range(ROUNDS):
        message = filled(chance, message_class(name))
        raw = encode(message)
        kept = canonical(name, raw)
        assert decode(name, kept) == decode(name, raw) == message
        assert len(kept) <= len(raw)
        assert canonical(name, kept) == kept


@pytest.mark.parametrize("name", TYPES)
def test_equal_messages_have_equal_bytes(name):
    """Whatever was in memory before, and whatever is in the gaps and after the end."""
    message = filled(random.Random(f"{name} again"), message_class(name))
    kept = canonical(name, encode(message))
    for size in (10, 1000, 100_000):
        _ = [encode(message_class("std_msgs/msg/String")(data="\xff" * size)) for _ in range(3)]
        assert canonical(name, encode(message)) == kept
    assert canonical(name, kept + b"left over") == kept


@pytest.mark.parametrize("name", TYPES)
def test_bytes_are_known_as_canonical_by_their_sizes(name):
    chance = random.Random(name)
    for _ in range(ROUNDS):
        raw = canonical(name, encode(filled(chance, message_class(name))))
        assert is_canonical(name, raw) == (name not in FOUND_BY_VALUES)
        for other in (raw[:-1], raw + b"\0", b"\0\0" + raw[2:], raw[:2] + b"\0\1" + raw[4:], b""):
            assert not is_canonical(name, other)


@pytest.mark.parametrize("name", sorted(set(TYPES) - FOUND_BY_VALUES))
def test_what_is_known_as_canonical_is_what_ros_writes(name):
    """Whatever is done to the bytes. Of the many that are not a number ROS writes one for another."""
    chance, kept = random.Random(name), 0
    for _ in range(20 * ROUNDS):
        raw = bytearray(canonical(name, encode(filled(chance, message_class(name)))))
        for _ in range(chance.randrange(1, 4)):
            raw[chance.randrange(4, len(raw))] = chance.choice((0, 1, 255, chance.randrange(256)))
        if is_canonical(name, bytes(raw)):
            message = decode(name, bytes(raw))
            kept += 1
            assert canonical(name, encode(message)) == raw or "nan" in repr(message)
    assert kept > 0


@pytest.mark.parametrize(
    "raw",
    [
        *(b"\0\0\0\0", b"\1\0\0\0a", b"\2\0\0\0\0\0", b"\2\0\0\0\xff\0"),  # a bad end, no UTF-8
        *(b"\1\0\0\0", b"\3\0\0\0a\0", b"\xff\xff\xff\xffa\0", b"\2\0\0", b""),  # the bytes end too early
    ],
)
def test_a_text_that_ros_would_write_otherwise_is_not_canonical(raw):
    assert is_canonical("std_msgs/msg/String", b"\0\1\0\0" + b"\2\0\0\0a\0")
    assert not is_canonical("std_msgs/msg/String", b"\0\1\0\0" + raw)


def test_a_sequence_longer_than_its_bytes_is_soon_given_up():
    """A node may publish any bytes; they go as they are, as on a robot."""
    name, raw = "tf2_msgs/msg/TFMessage", b"\0\1\0\0" + b"\xff\xff\xff\xff" + bytes(1000)
    assert not is_canonical(name, raw)
    assert canonical(name, raw) == raw


def test_gaps_are_cleared():
    from sensor_msgs.msg import Joy

    joy = Joy(axes=[1.0], buttons=[2])
    joy.header.frame_id = "j"
    raw = bytearray(encode(joy))
    clean = canonical("sensor_msgs/msg/Joy", bytes(raw))
    gap = 4 + 8 + 4 + 2  # encapsulation, stamp, length of frame_id, "j" and its end: two bytes of gap follow
    assert clean[gap : gap + 2] == b"\0\0"
    raw[gap : gap + 2] = b"\xaa\xbb"
    assert canonical("sensor_msgs/msg/Joy", bytes(raw)) == clean


def test_bytes_in_another_encoding_are_left_alone():
    raw = b"\x00\x00" + encode(message_class("std_msgs/msg/Int32")(data=5))[2:] + b"more"
    assert canonical("std_msgs/msg/Int32", raw) == raw


def test_a_wide_string_is_left_alone():
    """example_interfaces/WString: its layout depends on the implementation."""
    message = message_class("example_interfaces/msg/WString")(data="wide €")
    raw = encode(message)
    assert canonical("example_interfaces/msg/WString", raw) == raw
    assert decode("example_interfaces/msg/WString", raw) == message


def test_names_and_classes_belong_together():
    from example_interfaces.srv import AddTwoInts

    for name in TYPES:
        assert type_name(message_class(name)) == name
    assert type_name(AddTwoInts) == "example_interfaces/srv/AddTwoInts"


def test_arrays_of_every_kind_are_encoded_alike():
    scan = message_class("sensor_msgs/msg/LaserScan")
    values = [0.5, 1.5, 2.5]
    kinds = [values, array.array("f", values), np.array(values, dtype=np.float32)]
    assert len({canonical("sensor_msgs/msg/LaserScan", encode(scan(ranges=kind))) for kind in kinds}) == 1
