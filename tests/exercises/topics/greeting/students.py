"""Greeters: right ones, and wrong ones named by their defect."""

import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32, String


class Greeter(Node):
    """As in the assignment, with the line filled in."""

    type, topic, period = String, "/greeting", 0.5

    def __init__(self):
        super().__init__("greeter")
        self.publisher = self.create_publisher(self.type, self.topic, 10)
        self.create_timer(self.period, self.greet)

    def greet(self):
        self.publisher.publish(self.type())


def main_with_timer():
    rclpy.init()
    node = Node("hello")
    publisher = node.create_publisher(String, "greeting", 1)
    node.create_timer(0.5, lambda: publisher.publish(String(data="hello")))
    rclpy.spin(node)


def main_that_sleeps_between_greetings():
    rclpy.init()
    node = rclpy.create_node("greeter")
    publisher = node.create_publisher(String, "/greeting", qos_profile=5)
    while rclpy.ok():
        publisher.publish(String(data="Hi"))
        time.sleep(0.5)


class GreeterWithTwoTimersOfOneSecond(Node):
    def __init__(self):
        super().__init__("greeter")
        self.publisher = self.create_publisher(String, "/greeting", 10)
        self.create_timer(1.0, self.greet)
        time.sleep(0.5)
        self.create_timer(1.0, self.greet)

    def greet(self):
        self.publisher.publish(String(data="Hello!"))


class MisspeltTopic(Greeter):
    topic = "/greting"


class CapitalTopic(Greeter):
    topic = "/Greeting"


class TopicInNamespace(Greeter):
    topic = "/robot/greeting"


class NumbersInPlaceOfText(Greeter):
    type = Int32


class TooSlow(Greeter):
    period = 2.0


class SleepsInTheTimer(Greeter):
    def greet(self):
        time.sleep(1.0)
        super().greet()


class NeverPublishes(Greeter):
    def greet(self):
        String(data="Hello!")


class StopsAfterTwo(Greeter):
    count = 0

    def greet(self):
        self.count += 1
        if self.count <= 2:
            super().greet()


class PublisherUnderAnotherName(Node):
    def __init__(self):
        super().__init__("greeter")
        self.pub = self.create_publisher(String, "/greeting", 10)
        self.create_timer(0.5, self.greet)

    def greet(self):
        self.publisher.publish(String(data="Hello!"))


class NoQueueDepth(Greeter):
    def __init__(self):
        Node.__init__(self, "greeter")
        self.publisher = self.create_publisher(String, "/greeting")
