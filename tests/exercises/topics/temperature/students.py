"""Thermometers: right ones, and wrong ones named by their defect."""

import math
import random
import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32, Float64


class Thermometer(Node):
    """As one would write it."""

    type, topic, period = Float32, "/sensor/temperature", 1.0

    def __init__(self):
        super().__init__("thermometer")
        self.publisher = self.create_publisher(self.type, self.topic, 10)
        self.create_timer(self.period, self.measure)

    def measure(self):
        self.publisher.publish(self.type(data=self.read()))

    def read(self):
        return random.uniform(20.0, 25.0)


class RoundedThermometer(Thermometer):
    """Whole degrees, so a value comes twice in a row now and then."""

    def read(self):
        return float(random.randint(20, 25))


def main_with_rate():
    rclpy.init()
    node = Node("sensor")
    publisher = node.create_publisher(Float32, "sensor/temperature", 10)
    while rclpy.ok():
        now = node.get_clock().now().nanoseconds / 1e9
        publisher.publish(Float32(data=22.5 + 2.5 * math.sin(now)))
        rclpy.spin_once(node, timeout_sec=1.0)


def thermometer_made_by_a_function():
    node = Node("thermometer", namespace="sensor")
    publisher = node.create_publisher(Float32, "temperature", 10)
    node.create_timer(1.0, lambda: publisher.publish(Float32(data=20 + 5 * random.random())))
    return node


class ThermometerWithAsyncTimer(Thermometer):
    async def measure(self):
        super().measure()


class AnotherTypeAlone(Node):
    """Lesson 2's: a publisher of another type."""

    def __init__(self):
        super().__init__("thermometer")
        self.create_publisher(Float64, "/sensor/temperature", 10)


class Float64InPlaceOfFloat32(Thermometer):
    type = Float64


class TopicWithoutNamespace(Thermometer):
    topic = "temperature"


class TenTimesASecond(Thermometer):
    period = 0.1


class OnceOnly(Thermometer):
    measured = False

    def measure(self):
        if not self.measured:
            self.measured = True
            super().measure()


class SleepsASecondMore(Thermometer):
    def measure(self):
        time.sleep(1.5)
        super().measure()


class NewPublisherEachTime(Thermometer):
    def measure(self):
        self.publisher = self.create_publisher(self.type, self.topic, 10)
        super().measure()


class NewPublisherThatWaits(Thermometer):
    """Made for each message, and known to all by the time it speaks."""

    def measure(self):
        publisher = self.create_publisher(self.type, self.topic, 10)

        def speak():
            publisher.publish(self.type(data=self.read()))
            self.destroy_timer(timer)
            self.destroy_publisher(publisher)

        timer = self.create_timer(0.3, speak)


class TooWarm(Thermometer):
    def read(self):
        return random.uniform(20.0, 30.0)


class NotANumber(Thermometer):
    def read(self):
        return math.nan


class NewEveryFourSeconds(Thermometer):
    count = 0

    def read(self):
        self.count += 1
        return 20.0 + self.count // 4


class WholeNumber(Thermometer):
    def read(self):
        return random.randint(20, 25)


class PublishesTheBareNumber(Thermometer):
    def measure(self):
        self.publisher.publish(self.read())


class CallsTheCallback(Thermometer):
    def __init__(self):
        Node.__init__(self, "thermometer")
        self.publisher = self.create_publisher(Float32, self.topic, 10)
        self.create_timer(1.0, self.measure())
