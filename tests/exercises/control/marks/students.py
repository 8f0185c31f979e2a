"""Controllers that bring a cart to marks: right ones, and wrong ones named by their defect."""

import time

import rclpy
from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64


class Driver(Node):
    """As one would write it; the wrong ones change one thing each."""

    gains = 40.0, 6.0, 6.0, 8.0  # N per rad, rad/s, m, m/s
    limit = 3.0

    def __init__(self):
        super().__init__("driver")
        self.mark = 0.0
        self.publisher = self.create_publisher(Float64, "/cart_effort", 10)
        self.create_subscription(Float64, "/mark", self.on_mark, 10)
        self.create_subscription(JointState, "/joint_states", self.on_joints, 10)

    def on_mark(self, msg):
        self.mark = msg.data

    def on_joints(self, msg):
        (x, angle), (speed, rate) = msg.position, msg.velocity
        self.push(self.effort(x, angle, speed, rate))

    def effort(self, x, angle, speed, rate):
        pole, turn, place, way = self.gains
        return -pole * angle - turn * rate + place * (x - self.mark) + way * speed

    def push(self, effort):
        self.publisher.publish(Float64(data=max(-self.limit, min(self.limit, effort))))


class Cascade(Driver):
    """A design of its own: the place says how far to lean, and the lean says how hard to push."""

    def effort(self, x, angle, speed, rate):
        lean = 0.15 * (x - self.mark) + 0.2 * speed
        return -40.0 * (angle - max(-0.2, min(0.2, lean))) - 6.0 * rate


class OnATimer(Driver):
    """A loop of 100 Hz of its own."""

    joints = None

    def __init__(self):
        super().__init__()
        self.create_timer(0.01, self.loop)

    def on_joints(self, msg):
        self.joints = msg

    def loop(self):
        if self.joints:
            super().on_joints(self.joints)


def main_without_a_class():
    rclpy.init()
    node, mark = rclpy.create_node("driver"), [0.0]
    publisher = node.create_publisher(Float64, "/cart_effort", 10)

    def on_message(joints):
        (x, angle), (v, w) = joints.position, joints.velocity
        push = 6.0 * (x - mark[-1]) + 8.0 * v - 45.0 * angle - 7.0 * w
        publisher.publish(Float64(data=min(max(push, -2.9), 2.9)))

    node.create_subscription(Float64, "/mark", lambda msg: mark.append(msg.data), 10)
    node.create_subscription(JointState, "/joint_states", on_message, 10)
    rclpy.spin(node)


class AngleOnly(Driver):
    gains = 40.0, 6.0, 0.0, 0.0


class SignTurned(Driver):
    gains = -40.0, -6.0, -6.0, -8.0


class PlaceTurned(Driver):
    """Runs away from the mark."""

    gains = 40.0, 6.0, -6.0, -8.0


class NoLimit(Driver):
    limit = 1000.0


class StaysInTheMiddle(Driver):
    def on_mark(self, msg):
        pass


class OtherSide(Driver):
    def on_mark(self, msg):
        self.mark = -msg.data


class TooGentle(Driver):
    """Comes, and takes its time."""

    gains = 40.0, 6.0, 1.5, 4.0


class Hasty(Driver):
    """Brakes too late."""

    gains = 40.0, 6.0, 5.5, 4.4


class Deaf(Driver):
    """Listens to another topic."""

    def __init__(self):
        Node.__init__(self, "driver")
        self.mark = 0.0
        self.publisher = self.create_publisher(Float64, "/cart_effort", 10)
        self.create_subscription(JointState, "/joint_states", self.on_joints, 10)


class Waits(Driver):
    """Sleeps until the cart should have come."""

    def on_mark(self, msg):
        if msg.data != self.mark:
            time.sleep(1.0)
        super().on_mark(msg)


class Sluggish(Driver):
    """Moves the mark slowly to where it should be."""

    def on_mark(self, msg):
        self.mark += 0.03 * (msg.data - self.mark)
