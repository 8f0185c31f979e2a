"""Nodes that raise nothing, and do what no node should, named by it."""

import math
import threading
import time

import rclpy
from geometry_msgs.msg import Twist, Vector3
from rclpy.node import Node
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String


class Driver(Node):
    """Drives for two seconds and stops; nothing is wrong with it."""

    name, topic, period, speed, until = "driver", "/cmd_vel", 0.1, 0.2, 2.0

    def __init__(self):
        super().__init__(self.name)
        self.publisher = self.create_publisher(Twist, self.topic, 10)
        self.started = self.get_clock().now()
        self.create_timer(self.period, self.drive)

    def drive(self):
        driving = (self.get_clock().now() - self.started).nanoseconds < self.until * 1e9
        self.send(self.speed if driving else 0.0)

    def send(self, speed):
        self.publisher.publish(Twist(linear=Vector3(x=speed)))


class DrivesToTheEnd(Driver):
    """The run ends while it drives; nothing is wrong with that."""

    until = math.inf


class SecondDriver(Driver):
    """Wants to stand still where the other one drives."""

    name, speed = "second_driver", 0.0


class CommandsOnceASecond(Driver):
    period, until = 1.0, math.inf


class FallsSilent(Driver):
    def send(self, speed):
        if speed:
            super().send(speed)


class DividesByTheDistance(Driver):
    """Takes for its speed what it has last seen on its left, as a part of 1 m."""

    def __init__(self):
        super().__init__()
        self.distance = 1.0
        self.create_subscription(LaserScan, "/scan", self.look, 10)

    def look(self, scan):
        self.distance = scan.ranges[90]

    def send(self, speed):
        super().send(0.1 * self.distance)


class Chatter(Node):
    """Says something ten times a second; nothing is wrong with it."""

    def __init__(self):
        super().__init__("chatter")
        self.publisher = self.create_publisher(String, "chatter", 1)
        self.create_timer(0.1, lambda: self.publisher.publish(String()))


class SleepsOverMessages(Node):
    def __init__(self):
        super().__init__("sleeper")
        self.create_subscription(String, "chatter", self.on_message, 1)

    def on_message(self, msg):
        time.sleep(0.5)


class TalksWithoutAPause(Node):
    def __init__(self):
        super().__init__("talker")
        self.publisher = self.create_publisher(String, "chatter", 1)
        threading.Thread(target=self.talk, daemon=True).start()

    def talk(self):
        while rclpy.ok():
            self.publisher.publish(String())


class Once(Node):
    """Cancels its timer at the first call, and waits in it; nothing is wrong with it."""

    def __init__(self):
        super().__init__("once")
        self.timer = self.create_timer(0.5, self.go)

    def go(self):
        self.timer.cancel()
        time.sleep(1.0)
        self.get_logger().info("done")


class Greeter(Node):
    """Says one word and needs nothing else; nothing is wrong with it."""

    def __init__(self):
        super().__init__("greeter")
        self.get_logger().info("Hello")


def main_that_comes_to_its_end():
    """Nothing is wrong with it."""
    rclpy.init()
    node = Greeter()
    node.destroy_node()
    rclpy.shutdown()


class TakesTooNearForFree(Driver):
    """Stops for what is up to 0.13 m ahead, but where the robot touches a wall the lidar says -inf."""

    speed, until = 0.5, math.inf

    def __init__(self):
        super().__init__()
        self.free = True
        self.create_subscription(LaserScan, "/scan", self.look, 10)

    def look(self, scan):
        self.free = not 0.0 < scan.ranges[0] < 0.13

    def drive(self):
        self.send(self.speed if self.free else 0.0)


class BacksBlindly(Driver):
    speed, until = -0.5, math.inf


class TurnsAwayAtAWall(TakesTooNearForFree):
    """Touches the wall, and goes back at once."""

    def look(self, scan):
        self.speed = -0.5 if scan.ranges[0] < 0.2 else self.speed


class Hand(FallsSilent):
    name, topic, period, until = "hand", "/hand_vel", 1.0, 3.5


class PassesOn(Node):
    """Has no command of its own: it falls silent with who sends them."""

    def __init__(self):
        super().__init__("mux")
        publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(Twist, "/hand_vel", publisher.publish, 10)
