"""Nodes that log where joints are, in degrees: right ones, and wrong ones named by their defect."""

import math

import rclpy
from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray

JOINTS = "shoulder_joint", "elbow_joint"


class Monitor(Node):
    """As one would write it; the wrong ones change one thing each."""

    period = 1.0

    def __init__(self):
        super().__init__("joint_monitor")
        self.now = {}
        self.create_subscription(JointState, "/joint_states", self.on_state, 10)
        self.create_timer(self.period, self.show)

    def on_state(self, msg):
        for name, position in zip(msg.name, msg.position, strict=True):
            self.now[name] = position

    def show(self):
        for name in JOINTS:
            if name in self.now:
                self.log(name, self.now[name])

    def log(self, name, position):
        self.get_logger().info(f"{name}: {math.degrees(position):.1f} degrees")


class OneLineForBoth(Monitor):
    """A line that names both joints has both positions."""

    def show(self):
        known = {name: math.degrees(self.now[name]) for name in JOINTS if name in self.now}
        self.get_logger().info(", ".join(f"{name}: {angle:.2f} degrees" for name, angle in known.items()))


class ByTheClock(Monitor):
    """A design of its own: no timer; the callback looks at the clock, and logs when a second has passed."""

    def __init__(self):
        super().__init__()
        self.shown = dict.fromkeys(JOINTS, self.get_clock().now())

    def on_state(self, msg):
        now = self.get_clock().now()
        for name in set(msg.name) & self.shown.keys():
            if (now - self.shown[name]).nanoseconds >= 1e9:
                self.shown[name] = now
                self.log(name, msg.position[msg.name.index(name)])

    def show(self):
        pass


def main():
    """A program of functions, with numbers that are not rounded."""
    rclpy.init()
    node, newest = rclpy.create_node("monitor"), {}

    def show():
        for name, position in sorted(newest.items()):
            if name != "gripper_joint":
                node.get_logger().info(f"{name} = {position * 180 / math.pi}")

    def store(msg):
        newest.update(zip(msg.name, msg.position, strict=True))

    node.create_subscription(JointState, "joint_states", store, 10)
    node.create_timer(1.0, show)
    rclpy.spin(node)


class Radians(Monitor):
    def log(self, name, position):
        self.get_logger().info(f"{name}: {position:.3f}")


class ByIndex(Monitor):
    """The shoulder is not always the first, and the gripper has one joint only."""

    def on_state(self, msg):
        if len(msg.position) == 2:
            self.now = dict(zip(JOINTS, msg.position, strict=True))


class FirstForever(Monitor):
    """What came first stays."""

    def on_state(self, msg):
        for name, position in zip(msg.name, msg.position, strict=True):
            self.now.setdefault(name, position)


class ShowsCommands(Monitor):
    """Where the joints should be, and not where they are."""

    def __init__(self):
        super().__init__()
        self.create_subscription(Float64MultiArray, "/joint_commands", self.on_command, 10)

    def on_state(self, msg):
        pass

    def on_command(self, msg):
        self.now = dict(zip(JOINTS, msg.data, strict=True))


class EachMessage(Monitor):
    """Twenty lines a second are for no one."""

    def on_state(self, msg):
        for name, position in zip(msg.name, msg.position, strict=True):
            if name in JOINTS:
                self.log(name, position)

    def show(self):
        pass


class Throttled(Monitor):
    """The throttle belongs to the line of code, so the second joint is never logged."""

    def on_state(self, msg):
        for name, position in zip(msg.name, msg.position, strict=True):
            if name in JOINTS:
                text = f"{name}: {math.degrees(position):.1f} degrees"
                self.get_logger().info(text, throttle_duration_sec=1.0)

    def show(self):
        pass


class Prints(Monitor):
    def log(self, name, position):
        print(f"{name}: {math.degrees(position):.1f} degrees")


class IndexOfTheGripper(Monitor):
    """A gripper's message has no shoulder."""

    def on_state(self, msg):
        self.now = {name: msg.position[msg.name.index(name)] for name in JOINTS}


class ByIndexToo(Monitor):
    """A gripper's message has one position."""

    def on_state(self, msg):
        self.now = {"elbow_joint": msg.position[0], "shoulder_joint": msg.position[1]}


class OtherTopic(Monitor):
    def create_subscription(self, type_, topic, callback, depth):
        return super().create_subscription(type_, "/joint_state", callback, depth)
