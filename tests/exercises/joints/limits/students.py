"""Nodes that watch joints near their limits: right ones, and wrong ones named by their defect."""

import math
from xml.etree import ElementTree

import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import String

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Watcher(Node):
    """As one would write it; the wrong ones change one thing each."""

    latched, margin_to_speak, margin_to_forget = LATCHED, 0.1, 0.15

    def __init__(self):
        super().__init__("watcher")
        self.limits, self.near = {}, set()
        self.publisher = self.create_publisher(String, "/near_limit", 10)
        self.create_subscription(String, "/robot_description", self.read, self.latched)
        self.create_subscription(JointState, "/joint_states", self.watch, 10)

    def read(self, msg):
        for joint in ElementTree.fromstring(msg.data).findall("joint"):
            limit = joint.find("limit")
            if limit is not None:
                self.limits[joint.get("name")] = float(limit.get("lower")), float(limit.get("upper"))

    def watch(self, msg):
        for name, position in zip(msg.name, msg.position, strict=False):
            if name in self.limits:
                self.look_at(name, position)

    def look_at(self, name, position):
        margin = self.margin(name, position)
        if margin > self.margin_to_forget:
            self.near.discard(name)
        elif margin < self.margin_to_speak and name not in self.near:
            self.near.add(name)
            self.publisher.publish(String(data=name))

    def margin(self, name, position):
        lower, upper = self.limits[name]
        return min(position - lower, upper - position)


class WithADictionary(Watcher):
    """A design of its own: all positions in a dictionary, and a flag for each joint."""

    def watch(self, msg):
        positions = dict(zip(msg.name, msg.position, strict=False))
        for name, (lower, upper) in self.limits.items():
            if name not in positions:
                continue
            gap = 0.15 if name in self.near else 0.1
            close = not lower + gap < positions[name] < upper - gap
            if close and name not in self.near:
                self.publisher.publish(String(data=name))
            (self.near.add if close else self.near.discard)(name)


def main_without_a_class():
    rclpy.init()
    node = rclpy.create_node("watcher")
    publisher = node.create_publisher(String, "near_limit", 10)
    limits, close = {}, {}

    def read(msg):
        for joint in ElementTree.fromstring(msg.data).iterfind("joint[limit]"):
            limits[joint.attrib["name"]] = [
                float(joint.find("limit").attrib[end]) for end in ("lower", "upper")
            ]

    def watch(msg):
        for name in set(msg.name) & set(limits):
            position = msg.position[list(msg.name).index(name)]
            before = close.get(name, False)
            margin = min(position - limits[name][0], limits[name][1] - position)
            close[name] = margin < (0.15 if before else 0.1)
            if close[name] and not before:
                publisher.publish(String(data=name))

    node.create_subscription(String, "robot_description", read, LATCHED)
    node.create_subscription(JointState, "joint_states", watch, 10)
    rclpy.spin(node)


class ByIndex(Watcher):
    """As if the first were the shoulder, always."""

    def watch(self, msg):
        for name, position in zip(["shoulder_joint", "elbow_joint"], msg.position, strict=False):
            self.look_at(name, position)


class ForgetsTheGripper(Watcher):
    """KeyError with the first message of another driver."""

    def watch(self, msg):
        for name, position in zip(msg.name, msg.position, strict=False):
            self.look_at(name, position)


class Degrees(Watcher):
    def watch(self, msg):
        for name, position in zip(msg.name, msg.position, strict=False):
            if name in self.limits:
                self.look_at(name, math.degrees(position))


class UpperOnly(Watcher):
    def margin(self, name, position):
        return self.limits[name][1] - position


class Symmetric(Watcher):
    """As if the lower limit were the upper one's mirror."""

    def margin(self, name, position):
        return self.limits[name][1] - abs(position)


class LimitsByHeart(Watcher):
    """Those of the arm of the lesson."""

    def margin(self, name, position):
        most = {"shoulder_joint": 2.6, "elbow_joint": 2.4}[name]
        return most - abs(position)


class AllTheTime(Watcher):
    def look_at(self, name, position):
        if self.margin(name, position) < 0.1:
            self.publisher.publish(String(data=name))


class Volatile(Watcher):
    latched = 10


class WithoutAGap(Watcher):
    """Away where it is no longer near: at the margin the noise decides, in each message anew."""

    margin_to_forget = 0.1


class OtherTopic(Watcher):
    def __init__(self):
        Node.__init__(self, "watcher")
        self.limits, self.near = {}, set()
        self.publisher = self.create_publisher(String, "/near_limit", 10)
        self.create_subscription(String, "/robot_description", self.read, LATCHED)
        self.create_subscription(JointState, "/joints", self.watch, 10)


class LimitsForAll(Watcher):
    """As if each joint without limits could turn from 0 to 1 rad."""

    def watch(self, msg):
        for name, position in zip(msg.name, msg.position, strict=False):
            self.limits.setdefault(name, (0.0, 1.0))
            self.look_at(name, position)
