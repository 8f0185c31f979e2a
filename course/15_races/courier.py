"""A courier for a corridor: it drives until its lidar sees something ahead. Two callbacks, two threads."""

from dataclasses import replace

import rclpy
from geometry_msgs.msg import Twist
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from sim import World
from sim.world import MovableBox

YARD = World.load("yard")
CORRIDOR = replace(  # its robot obeys the last command, however old it is
    YARD,
    name="corridor",
    bounds=(-1.0, -1.2, 4.0, 1.2),
    walls=(((-1.0, -1.0), (4.0, -1.0)), ((-1.0, 1.0), (4.0, 1.0))),
    movable=(MovableBox(1.3, 0.0, 0.0, width=0.4, height=0.4, mass=0.6),),
    robot=replace(YARD.robot, command_timeout=1000.0),
)
UNLUCKY = "host-149"  # one of three orders among the first 200 in which it drives into the box


class Courier(Node):
    def __init__(self):
        super().__init__("courier")
        self.driving = True
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        group = ReentrantCallbackGroup()
        self.create_subscription(
            LaserScan, "/scan", self.on_scan, qos_profile_sensor_data, callback_group=group
        )
        self.create_timer(0.1, self.drive, callback_group=group)

    def on_scan(self, scan):
        ahead = min(scan.ranges[:10] + scan.ranges[-10:])
        if ahead < 0.5 and self.driving:
            self.driving = False
            self.send(0.0)

    def drive(self):
        if self.driving:
            self.send(0.3)

    def send(self, speed):
        command = Twist()
        command.linear.x = speed
        self.publisher.publish(command)


class Wall(Node):
    """In place of a robot: a lidar that comes 2 cm nearer to a wall with each scan, from 0.73 m on."""

    def __init__(self):
        super().__init__("wall")
        self.distance = 0.73
        self.publisher = self.create_publisher(LaserScan, "/scan", qos_profile_sensor_data)
        self.create_timer(0.05, self.measure)

    def measure(self):
        """Publish a scan."""
        self.distance -= 0.02
        self.publisher.publish(scan_of(self.distance))


def scan_of(distance):
    """A scan that measures the same distance (m) all around."""
    return LaserScan(ranges=[distance] * 360)


def spun(node, threads=2):
    """A main() that spins a node of this class with so many threads."""

    def main():
        rclpy.init()
        executor = MultiThreadedExecutor(threads)
        executor.add_node(node())
        executor.spin()

    return main


main = spun(Courier)
