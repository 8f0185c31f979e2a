"""Another robot's lidar, with rays of every kind."""

import math
import random

from rclpy.node import Node
from sensor_msgs.msg import LaserScan

RAYS = 180


class StrangeLidar(Node):
    """Another robot's lidar: scans (LaserScan) on /scan, two a second.

    It has 180 rays, and its first one looks back. Distances come from the run's seed. In turn, all rays are
    well, some are lost (nan), some meet nothing (inf), or some meet what is too near (-inf).
    """

    def __init__(self) -> None:
        super().__init__("strange_lidar")
        self.publisher = self.create_publisher(LaserScan, "/scan", 10)
        self.count = 0
        self.create_timer(0.5, self.measure)

    def measure(self) -> None:
        """Make up a scan, and publish it."""
        ranges = [random.uniform(2.5, 3.0) for _ in range(RAYS)]
        for middle in range(0, RAYS, 15):  # an obstacle in each direction, in the sectors and between
            distance = random.uniform(0.4, 2.4)
            ranges[middle - 1], ranges[middle], ranges[(middle + 1) % RAYS] = distance, distance, distance
        (_leave, _lose, _clear, _come_near)[self.count % 4](ranges)
        self.count += 1
        msg = LaserScan(angle_min=-math.pi, angle_increment=math.tau / RAYS, range_min=0.12, range_max=3.5)
        msg.angle_max = msg.angle_min + (RAYS - 1) * msg.angle_increment
        msg.header.stamp, msg.header.frame_id = self.get_clock().now().to_msg(), "laser"
        msg.ranges = ranges
        self.publisher.publish(msg)


def _leave(ranges: list[float]) -> None:
    """All is well."""


def _lose(ranges: list[float]) -> None:
    """One ray in eight gets lost; always the first, and those ahead, to the left and to the right."""
    for ray in {0, 45, 90, 135, *random.sample(range(RAYS), RAYS // 8)}:
        ranges[ray] = math.nan


def _clear(ranges: list[float]) -> None:
    """Half of the world is empty: ahead and to the left, or to the right."""
    empty = range(73, 154) if random.random() < 0.5 else range(26, 65)
    for ray in empty:
        ranges[ray] = math.inf


def _come_near(ranges: list[float]) -> None:
    """Something comes nearer than the lidar can measure, in one of the three directions."""
    ranges[random.choice((45, 90, 135)) + random.randint(-8, 8)] = -math.inf
