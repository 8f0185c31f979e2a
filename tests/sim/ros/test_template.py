"""Templates give the bytes that setting fields and serializing would give."""

import array
import random

import pytest
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import JointState, LaserScan
from std_msgs.msg import Header
from tf2_msgs.msg import TFMessage
from turtlesim.msg import Color, Pose

from sim.ros.messages.cdr import canonical
from sim.ros.messages.codec import encode, type_name
from sim.ros.messages.decoder import decode
from sim.ros.messages.template import Template


def expected(message):
    return canonical(type_name(type(message)), encode(message))


def test_numbers_strings_around_them_and_sequences_are_patched():
    scan = LaserScan(header=Header(frame_id="x"), ranges=array.array("f", [0.0] * 5))
    template = Template(scan, ["header.stamp.sec", "header.stamp.nanosec", "ranges"])
    for number in range(3):
        ranges = array.array("f", [number + ray / 8 for ray in range(5)])
        scan.header.stamp.sec, scan.header.stamp.nanosec, scan.ranges = number, number * 7, ranges
        assert bytes(template.fill(number, number * 7, ranges.tobytes())) == expected(scan)


def test_a_float64_sequence_takes_one_number_each():
    joints = JointState(name=["a", "bc"], position=[0.0, 0.0], velocity=[0.0, 0.0])
    template = Template(joints, ["position", "velocity"])
    joints.position, joints.velocity = [1.5, 2.5], [3.5, -4.5]
    assert bytes(template.fill(1.5, 2.5, 3.5, -4.5)) == expected(joints)


def test_fields_inside_sequences_are_reached():
    transform = TransformStamped(header=Header(frame_id="odom"), child_frame_id="base_link")
    message = TFMessage(transforms=[transform])
    template = Template(
        message, ["transforms.0.transform.translation.x", "transforms.0.transform.rotation.w"]
    )
    chance = random.Random(5)
    for _ in range(20):
        x, w = chance.uniform(-1e6, 1e6), chance.uniform(-1, 1)
        transform.transform.translation.x, transform.transform.rotation.w = x, w
        raw = bytes(template.fill(x, w))
        assert raw == expected(message)
        assert decode("tf2_msgs/msg/TFMessage", raw) == message


def test_the_message_itself_stays_as_it_was():
    joints = JointState(name=["a"], position=[1.0])
    Template(joints, ["position", "header.stamp.sec"])
    assert joints == JointState(name=["a"], position=[1.0])


def test_a_value_too_many_or_too_few_is_refused():
    template = Template(JointState(position=[0.0]), ["position"])
    for values in ((), (1.0, 2.0)):
        with pytest.raises(TypeError, match="positional argument"):
            template.fill(*values)


def test_float32_and_single_bytes_are_patched():
    pose, color = Pose(), Color()
    template = Template(pose, ["x", "theta"])
    pose.x, pose.theta = 5.5, -0.25
    assert bytes(template.fill(5.5, -0.25)) == expected(pose)
    template = Template(color, ["r", "g", "b"])
    color.r, color.g, color.b = 179, 17, 255
    assert bytes(template.fill(179, 17, 255)) == expected(color)
