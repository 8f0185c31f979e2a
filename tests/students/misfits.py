"""Nodes that raise nothing and still go wrong: names, types, QoS, waiting callbacks, nodes no one spins."""

import time

import rclpy
from example_interfaces.srv import Trigger
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import Float64, String


class Talker(Node):
    """Says hello once a second; nothing is wrong with it."""

    topic, type, qos = "/chatter", String, 10

    def __init__(self):
        super().__init__("talker")
        self.publisher = self.create_publisher(self.type, self.topic, self.qos)
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.publisher.publish(self.type())


class Listener(Node):
    """Receives what is said on /chatter; nothing is wrong with it."""

    topic, type, qos = "/chatter", String, 10

    def __init__(self):
        super().__init__("listener")
        self.create_subscription(self.type, self.topic, self.on_message, self.qos)

    def on_message(self, msg):
        self.get_logger().info("received")


class MisspeltTopic(Talker):
    topic = "/chater"


class CapitalTopic(Talker):
    topic = "/Chatter"


class TopicInNamespace(Talker):
    topic = "/robot1/chatter"


class NumberTalker(Talker):
    type = Float64


class BestEffortTalker(Talker):
    qos = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)


class LatchedListener(Listener):
    qos = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class ImpatientListener(Listener):
    qos = QoSProfile(depth=10, deadline=Duration(seconds=0.5))


class ListenerForTheLiving(Listener):
    qos = QoSProfile(depth=10, liveliness=LivelinessPolicy.MANUAL_BY_TOPIC)


class SleepyTalker(Talker):
    def tick(self):
        time.sleep(3.0)
        super().tick()


class SleepyOnce(Talker):
    def tick(self):
        time.sleep(8.5)
        super().tick()


class SilentTalker(Talker):
    def tick(self):
        pass


class TalkerWithoutTimer(Node):
    def __init__(self):
        super().__init__("talker")
        self.publisher = self.create_publisher(String, "/chatter", 10)


class TalksInItsConstructor(TalkerWithoutTimer):
    def __init__(self):
        super().__init__()
        self.publisher.publish(String(data="hello"))


class SaysItAgain(TalksInItsConstructor):
    """The first of its words reaches no one, and the second is the same; nothing is wrong with it."""

    def __init__(self):
        super().__init__()
        self.create_timer(1.0, lambda: self.publisher.publish(String(data="hello")))


class NewPublisherEachTime(Node):
    def __init__(self):
        super().__init__("talker")
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.create_publisher(String, "/chatter", 10).publish(String(data="hello"))


class NewPublisherForTheNextMessage(NewPublisherEachTime):
    """All have found it by the time that message comes; nothing is wrong with it."""

    def __init__(self):
        super().__init__()
        self.publisher = self.create_publisher(String, "/chatter", 10)

    def tick(self):
        self.publisher.publish(String(data="hello"))
        self.publisher = self.create_publisher(String, "/chatter", 10)


class NewPublisherThatLatches(NewPublisherEachTime):
    """What it says is there for all who come later; nothing is wrong with it."""

    def tick(self):
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_publisher(String, "/chatter", latched).publish(String(data="hello"))


class RateForPeriod(Node):
    """Meant to talk 100 times a second."""

    def __init__(self):
        super().__init__("talker")
        self.publisher = self.create_publisher(String, "/chatter", 10)
        self.create_timer(100, lambda: self.publisher.publish(String()))


class SilentEcho(Listener):
    """Receives /chatter, and should answer on /echo."""

    def __init__(self):
        super().__init__()
        self.publisher = self.create_publisher(String, "/echo", 10)


class Empty(Node):
    def __init__(self):
        super().__init__("talker")


def main_without_spin():
    rclpy.init()
    node = Talker()
    node.destroy_node()
    rclpy.shutdown()


def main_that_only_sleeps():
    rclpy.init()
    Talker()
    time.sleep(60.0)


def main_that_sleeps_over_messages():
    rclpy.init()
    Listener()
    time.sleep(60.0)


def main_that_listens_without_spin():
    rclpy.init()
    Listener()
    rclpy.shutdown()


def main_that_spins_three_seconds():
    rclpy.init()
    node = Talker()
    end = node.get_clock().now() + Duration(seconds=3.5)
    while node.get_clock().now() < end:
        rclpy.spin_once(node)
    rclpy.shutdown()


def main_that_never_ends():
    rclpy.init()
    while True:
        pass


class LoopsInItsConstructor(Node):
    def __init__(self):
        super().__init__("looper")
        while True:
            pass


class LoopsInACallback(Talker):
    def tick(self):
        while True:
            pass


class Echo(Node):
    """Answers each message with another on the same topic: it receives itself."""

    def __init__(self):
        super().__init__("echo")
        self.publisher = self.create_publisher(String, "/chatter", 10)
        self.create_subscription(String, "/chatter", self.publisher.publish, 10)
        self.create_timer(1.0, lambda: self.publisher.publish(String()))


class Deadlock(Node):
    """Waits in a callback for the answer of a service of its own."""

    def __init__(self):
        super().__init__("deadlock")
        self.create_service(Trigger, "poke", lambda request, response: response)
        self.client = self.create_client(Trigger, "poke")
        self.create_timer(1.0, lambda: self.client.call(Trigger.Request()))
