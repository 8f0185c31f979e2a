"""Nodes that publish under conditions that no short run fulfills, and that are right all the same."""

import contextlib
import random

import rclpy
from geometry_msgs.msg import Twist
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from rclpy.node import Node
from std_msgs.msg import String


class Events(Node):
    """Publishes an event when it is due."""

    def __init__(self):
        super().__init__("events")
        self.publisher = self.create_publisher(String, "events", 10)
        self.begin, self.count, self.random = self.get_clock().now(), 0, random.Random(3)
        self.create_timer(0.1, self.tick)

    def tick(self):
        if self.is_due():
            self.publisher.publish(String(data="due"))


class HalfAMinuteLater(Events):
    def is_due(self):
        return self.get_clock().now() - self.begin > Duration(seconds=30)


class EachHundredth(Events):
    def tick(self):
        self.count += 1
        if self.count % 100 == 0:
            self.publisher.publish(String(data="due"))


class AtRandom(Events):
    def tick(self):
        if self.random.random() < 0.001:
            self.publisher.publish(String(data="due"))


class InTheAfternoon(Events):
    def tick(self):
        seconds = (self.get_clock().now() - self.begin).nanoseconds / 1e9
        if seconds >= 30.0:
            self.publisher.publish(String(data="due"))


class MissesANode(Events):
    """Publishes when the robot's node is gone."""

    def tick(self):
        names = [name for name, _ in self.get_node_names_and_namespaces()]
        if "robot" not in names:
            self.publisher.publish(String(data="no robot"))


class Modes(Node):
    """Another node says what it should do."""

    def __init__(self):
        super().__init__("modes")
        self.mode = "idle"
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(String, "mode", self.receive, 10)
        self.create_timer(0.1, self.tick)

    def receive(self, message):
        self.mode = message.data

    def tick(self):
        match self.mode:
            case "drive":
                twist = Twist()
                twist.linear.x = 0.1
                self.publisher.publish(twist)
            case "stop":
                self.publisher.publish(Twist())


class Inactive(LifecycleNode):
    """Waits for its manager; publishes whatever its state is, and only what is active is sent."""

    def __init__(self):
        super().__init__("inactive")
        self.sender = self.create_lifecycle_publisher(String, "status", 10)
        self.create_timer(0.2, self.tick)

    def tick(self):
        self.sender.publish(String(data="active"))


class HasAFlag(LifecycleNode):
    """The same, with a flag of its own, and a publisher of every node."""

    def __init__(self):
        super().__init__("has_a_flag")
        self.active = False
        self.sender = self.create_publisher(String, "status", 10)
        self.create_timer(0.2, self.tick)

    def on_activate(self, state):
        self.active = True
        return super().on_activate(state)

    def tick(self):
        if self.active:
            self.sender.publish(String(data="active"))


class Configured(LifecycleNode):
    """Logs while it is inactive, as the talker of lifecycle_py does."""

    def __init__(self):
        super().__init__("configured")
        self.sender = None

    def on_configure(self, state):
        self.sender = self.create_lifecycle_publisher(String, "status", 10)
        self.timer = self.create_timer(0.5, self.tick)
        return TransitionCallbackReturn.SUCCESS

    def tick(self):
        if self.sender is None or not self.sender.is_activated:
            self.get_logger().info("inactive: nothing is published")
        else:
            self.sender.publish(String(data="active"))


def configures_itself():
    rclpy.init()
    node = Configured()
    node.trigger_configure()
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(node)


CORPUS = [
    (HalfAMinuteLater,),
    (EachHundredth,),
    (AtRandom,),
    (InTheAfternoon,),
    (MissesANode,),
    (Modes,),
    (Inactive,),
    (HasAFlag,),
    (configures_itself,),
]
