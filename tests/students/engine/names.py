"""Names, arguments, QoS and lifecycle: what connects nodes, and what keeps them apart."""

import sys
import time

import rclpy
from rcl_interfaces.msg import Log
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rclpy.wait_for_message import wait_for_message
from std_msgs.msg import Int32, String

from sim import Process

LATCHED = QoSProfile(depth=3, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Talker(Node):
    """Publishes its parameter `word` on chatter, `rate` times a second."""

    def __init__(self, **settings):
        super().__init__("talker", **settings)
        self.word = self.declare_parameter("word", "hello").value
        self.words = self.declare_parameter("words", ["a"]).value
        rate = self.declare_parameter("rate", 1.0).value
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.create_timer(1.0 / rate, self.tick)

    def tick(self):
        self.publisher.publish(String(data=self.word))


def arguments_to_init(args=None):
    """Settings written into init() itself, as a test program does."""
    words = ["--ros-args", "-r", "__node:=al", "-r", "__ns:=/r2", "-r", "chatter:=said", "-p", "word:=hi"]
    rclpy.init(args=words)
    rclpy.spin(Talker())


def arguments_to_node():
    """Settings for one node alone."""
    rclpy.init()
    rclpy.spin(Talker(namespace="r3", cli_args=["--ros-args", "-p", "word:=own"]))


def arguments_from_the_command_line():
    """sys.argv is read by init() when it gets none."""
    rclpy.init(args=sys.argv)
    rclpy.spin(Talker())


def not_for_this_node():
    rclpy.init()
    rclpy.spin(Talker(use_global_arguments=False))


def launches():
    """As a launch file would: says what to run, with its settings."""
    return Process(Talker, name="launched", parameters={"word": "go"})


class LatchedTalker(Node):
    """Publishes four numbers at once; a late joiner gets the last three."""

    def __init__(self):
        super().__init__("latched")
        publisher = self.create_publisher(Int32, "map", LATCHED)
        for number in range(4):
            publisher.publish(Int32(data=number))


def late_listener():
    time.sleep(2.0)
    rclpy.init()
    node = Node("late")
    node.create_subscription(Int32, "map", lambda msg: node.get_logger().info(str(msg.data)), LATCHED)
    rclpy.spin(node)


class Bursts(Node):
    """Publishes five numbers at once, each second, to listeners with room for two and for ten."""

    def __init__(self):
        super().__init__("bursts")
        publisher = self.create_publisher(Int32, "burst", 10)
        for depth in (2, 10):
            self.create_subscription(Int32, "burst", lambda msg, d=depth: self.on_message(d, msg), depth)
        self.create_timer(1.0, lambda: [publisher.publish(Int32(data=n)) for n in range(5)])

    def on_message(self, depth, msg):
        self.get_logger().info(f"{depth}: {msg.data}")


class Mismatch(Node):
    """Best effort on one side, reliable on the other: rclpy warns, and nothing arrives."""

    def __init__(self):
        super().__init__("mismatch")
        self.publisher = self.create_publisher(Int32, "data", qos_profile_sensor_data)
        self.create_subscription(Int32, "data", lambda msg: self.get_logger().info("received"), 10)
        self.create_timer(1.0, lambda: self.publisher.publish(Int32()))


def waits_for_message():
    """One message, without a callback; the talker speaks at 1 s."""
    rclpy.init()
    node = Node("waiter")
    found, message = wait_for_message(String, node, "chatter", time_to_wait=3.0)
    node.get_logger().info(f"{found} {message.data}")
    found, message = wait_for_message(String, node, "silence", time_to_wait=0.5)
    node.get_logger().info(f"{found} {message}")


class Switched(LifecycleNode):
    """Publishes twice a second while it is active."""

    def on_configure(self, state):
        self.publisher = self.create_lifecycle_publisher(Int32, "count", 10)
        self.timer = self.create_timer(0.5, lambda: self.publisher.publish(Int32(data=1)))
        self.get_logger().info("configured")
        return TransitionCallbackReturn.SUCCESS

    def on_cleanup(self, state):
        self.destroy_timer(self.timer)
        self.destroy_publisher(self.publisher)
        self.get_logger().info("cleaned up")
        return TransitionCallbackReturn.SUCCESS


def lifecycle():
    rclpy.init()
    node = Switched("switched")
    steps = [node.trigger_configure, node.trigger_activate, node.trigger_deactivate, node.trigger_cleanup]

    def step():
        steps.pop(0)()
        if not steps:
            timer.cancel()

    timer = node.create_timer(0.75, step)
    rclpy.spin(node)


class Restless(Node):
    """Makes and destroys publishers, subscriptions and timers as it goes."""

    def __init__(self):
        super().__init__("restless")
        self.made = None
        self.create_timer(1.0, self.change)

    def change(self):
        if self.made is None:
            publisher = self.create_publisher(Int32, "now", 10)
            subscription = self.create_subscription(Int32, "now", self.on_message, 10)
            self.made = publisher, subscription, self.create_timer(0.4, self.tick)
            return
        publisher, subscription, timer = self.made
        self.made = None
        self.destroy_timer(timer)
        self.destroy_subscription(subscription)
        self.destroy_publisher(publisher)

    def tick(self):
        self.made[0].publish(Int32(data=1))

    def on_message(self, msg):
        self.get_logger().info("received")


class Introspective(Node):
    """Asks the graph who is there."""

    def __init__(self):
        super().__init__("asker")
        self.create_timer(1.0, self.ask)

    def ask(self):
        topics = [name for name, _ in self.get_topic_names_and_types() if name == "/chatter"]
        say = self.get_logger().info
        say(f"{sorted(self.get_node_names())} {topics}")
        say(f"{self.count_publishers('/chatter')} {self.count_subscribers('/chatter')}")


class Logs(Node):
    """Says something of every severity, once a second."""

    def __init__(self):
        super().__init__("logs")
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.get_logger().debug("debug")
        self.get_logger().info("info")
        self.get_logger().warning("warning")


class ReceivesLogs(Node):
    """Receives what others log."""

    def __init__(self):
        super().__init__("receives_logs")
        self.create_subscription(Log, "/rosout", self.on_message, 10)

    def on_message(self, msg):
        if msg.name != self.get_name():
            print(f"{msg.name}: {msg.msg}")


class ReceivesPlaces(ReceivesLogs):
    """Receives from where they do."""

    def on_message(self, msg):
        print(f"{msg.file} {msg.function} {msg.line}")
