"""A program that fails on another driver's message reads that; its other mistakes get advice of their own."""

import pytest
from rclpy.node import Node
from sensor_msgs.msg import JointState

from grader.diagnosis import find_fault
from sim import run

ARM, GRIPPER = ["shoulder", "elbow"], ["gripper_joint"]


class Drivers(Node):
    """Publishes the joints of an arm, and then those of a gripper, as two drivers do."""

    def __init__(self):
        super().__init__("drivers")
        self.publisher = self.create_publisher(JointState, "/joint_states", 10)
        self.sent = iter([ARM, GRIPPER])
        self.create_timer(0.1, self.tick)

    def tick(self):
        names = next(self.sent, None)
        if names:
            self.publisher.publish(JointState(name=names, position=[0.5] * len(names)))


class Reader(Node):
    """Reads each message in one line of code."""

    def __init__(self, read):
        super().__init__("reader")
        self.read = read
        self.create_subscription(JointState, "/joint_states", self.on_joints, 10)

    def on_joints(self, msg):
        self.read(msg)


def by_name(msg):
    return dict(zip(msg.name, msg.position, strict=True))


@pytest.mark.parametrize(
    ("read", "is_due_to_the_message"),
    [
        (lambda msg: by_name(msg)["elbow"], True),
        (lambda msg: msg.position[msg.name.index("elbow")], True),
        (lambda msg: msg.position[1], True),
        # The gripper's message has its joint; the program's own dictionary doesn't.
        (lambda msg: [{"shoulder": 1.0, "elbow": 1.0}[name] for name in msg.name], False),
        # No message ever had such a joint.
        (lambda msg: len(msg.name) == 1 and by_name(msg)["speed"], False),
    ],
)
def test_only_a_joint_that_the_message_lacks_is_due_to_the_message(read, is_due_to_the_message):
    fault = find_fault(run(lambda: Reader(read), Drivers, seconds=1, quiet=True))
    begin = "The message on /joint_states at 0.2 s has only gripper_joint: several programs publish there"
    assert fault.hint.startswith(begin) is is_due_to_the_message, fault.hint
