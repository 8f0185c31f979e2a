"""Robots that turn until it is free: right ones, and wrong ones named by their defect."""

import math
import random

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan


class Wanderer(Node):
    """As one would write it."""

    half, limit, speed, turn, topic = 35, 0.5, 0.3, 1.0, "/cmd_vel"

    def __init__(self):
        super().__init__("wanderer")
        self.publisher = self.create_publisher(Twist, self.topic, 10)
        self.create_subscription(LaserScan, "/scan", self.look, 10)

    def look(self, msg):
        command = Twist()
        self.choose(command, min([*msg.ranges[: self.half], *msg.ranges[-self.half :]]))
        self.publisher.publish(command)

    def choose(self, command, ahead):
        if ahead < self.limit:
            command.angular.z = self.turn
        else:
            command.linear.x = self.speed


class ObstacleAvoider(Node):
    """A tutorial's node: slices of the ranges, a timer, and the side that has more room."""

    def __init__(self):
        super().__init__("obstacle_avoider")
        self.cmd_pub = self.create_publisher(Twist, "/cmd_vel", 10)
        self.scan_sub = self.create_subscription(
            LaserScan, "/scan", self.scan_callback, qos_profile_sensor_data
        )
        self.timer = self.create_timer(0.1, self.control_loop)
        self.regions = None
        self.turning = 0.0

    def scan_callback(self, msg):
        self.regions = {
            "front": min(min(min(msg.ranges[0:40]), min(msg.ranges[320:360])), 10),
            "left": min(min(msg.ranges[40:100]), 10),
            "right": min(min(msg.ranges[260:320]), 10),
        }

    def control_loop(self):
        if self.regions is None:
            return
        twist = Twist()
        if self.regions["front"] > 0.5:
            twist.linear.x = 0.22
            self.turning = 0.0
        else:
            if not self.turning:
                self.turning = 0.8 if self.regions["left"] > self.regions["right"] else -0.8
            twist.angular.z = self.turning
        self.cmd_pub.publish(twist)


def main():
    """States and a random turn."""
    rclpy.init()
    node = Node("bouncer")
    publisher = node.create_publisher(Twist, "cmd_vel", 10)
    state = {"until": 0.0, "turn": 0.0}

    def on_scan(scan):
        now = node.get_clock().now().nanoseconds / 1e9
        nearest = min(r for i, r in enumerate(scan.ranges) if math.cos(i * scan.angle_increment) > 0.75)
        msg = Twist()
        if nearest < 0.45 and now >= state["until"]:
            state["until"] = now + random.uniform(1.0, 2.0)
            state["turn"] = state["turn"] or random.choice((-1.2, 1.2))
        if now < state["until"]:
            msg.angular.z = state["turn"]
        else:
            state["turn"] = 0.0
            msg.linear.x = 0.3
        publisher.publish(msg)

    node.create_subscription(LaserScan, "scan", on_scan, 10)
    rclpy.spin(node)


class SlowInFrontOfWalls(Wanderer):
    """A design of its own: the nearer something is, the slower it drives."""

    async def look(self, msg):
        super().look(msg)

    def choose(self, command, ahead):
        command.linear.x = min(0.5, max(0.0, 0.8 * (ahead - 0.3)))
        command.angular.z = -1.0 if ahead < 0.5 else 0.0


class TurnsRight(Wanderer):
    """A tutorial robot of small speeds."""

    half, limit, speed, turn = 30, 0.6, 0.2, -0.5


class LooksThroughAStraw(Wanderer):
    half = 1


class HalfBlind(Wanderer):
    """The rays from 0 to 60 degrees only: blind on the right."""

    def look(self, msg):
        command = Twist()
        self.choose(command, min(msg.ranges[0:60]))
        self.publisher.publish(command)


class LooksAllRound(Wanderer):
    """min(msg.ranges): the wall beside the robot stays near, however long it turns."""

    def look(self, msg):
        command = Twist()
        self.choose(command, min(msg.ranges))
        self.publisher.publish(command)


class LooksBack(Wanderer):
    def look(self, msg):
        command = Twist()
        self.choose(command, min(msg.ranges[150:210]))
        self.publisher.publish(command)


class NeverTurns(Wanderer):
    """Stops, and that is all."""

    turn = 0.0


class TurnsWhileItDrives(Wanderer):
    def choose(self, command, ahead):
        command.linear.x = 0.5
        if ahead < self.limit:
            command.angular.z = 0.5


class ToAndFro(Wanderer):
    """Chooses the side anew in each scan."""

    turn = property(lambda self: random.choice((-1.0, 1.0)))


class Creeps(Wanderer):
    speed = 0.03


class MisspeltTopic(Wanderer):
    topic = "/cmdvel"


class SumOfSlices(Wanderer):
    """min() of two arrays gives an array, not a number."""

    def look(self, msg):
        command = Twist()
        self.choose(command, min(msg.ranges[:35], msg.ranges[-35:]))
        self.publisher.publish(command)


class SlicePastTheEnd(Wanderer):
    def look(self, msg):
        return min(msg.ranges[-35:36])


class Stands(Wanderer):
    """Publishes zeros."""

    def choose(self, command, ahead):
        pass
