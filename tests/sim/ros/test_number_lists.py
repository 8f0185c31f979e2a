"""Fields for lists of numbers take what stock ROS takes, and refuse the rest in a run as before."""

import array

import numpy as np
import pytest
from geometry_msgs.msg import PoseWithCovariance
from rclpy.node import Node
from sensor_msgs.msg import JointState, Joy
from std_msgs.msg import Float64, UInt8MultiArray

from sim import run


def publish(message_type, make):
    """What arrives of the message that a node makes, or what it raises."""

    class Sender(Node):
        def __init__(self):
            super().__init__("sender")
            self.publisher = self.create_publisher(message_type, "data", 10)
            self.create_timer(0.5, lambda: self.publisher.publish(make()))

    recording = run(Sender, seconds=0.6, quiet=True)
    return recording.errors[0].type if recording.errors else recording.messages("/data")[0].message


@pytest.mark.parametrize(
    "values",
    [[0, 2], (0, 2), [0, 2.0], np.array([0, 2]), np.array([0.0, 2.0], np.float32), array.array("i", [0, 2])],
    ids=str,
)
def test_whole_numbers_are_taken_for_floats(values):
    def assigned():
        message = JointState()
        message.velocity = values
        return message

    assert list(publish(JointState, assigned).velocity) == [0.0, 2.0]
    assert list(publish(JointState, lambda: JointState(velocity=values)).velocity) == [0.0, 2.0]


def test_lists_of_a_fixed_length_take_them_too():
    sent = publish(PoseWithCovariance, lambda: PoseWithCovariance(covariance=[1] * 36))
    assert list(sent.covariance) == [1.0] * 36


@pytest.mark.parametrize(
    ("message_type", "field", "value"),
    [
        (JointState, "velocity", ["0"]),
        (JointState, "velocity", [None]),
        (JointState, "velocity", 0),
        (PoseWithCovariance, "covariance", [1] * 35),
        (Joy, "buttons", [0.5]),
        (UInt8MultiArray, "data", [256]),
        (Float64, "data", 1),
    ],
)
def test_other_values_are_refused(message_type, field, value):
    def make():
        message = message_type()
        setattr(message, field, value)
        return message

    assert publish(message_type, make) == "AssertionError"
