"""Nodes of ours that send: a lidar over radio, and a map server with a visitor who comes late."""

from __future__ import annotations

import contextlib
import math
import random

from nav_msgs.msg import OccupancyGrid
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Int32

from sim import Network

PERIODS = 0.09, 0.14  # s between two scans: more than one can be later than another on the way
UNEVEN = 0.2  # of a period
RADIO = Network(loss=0.2, delay=0.05, jitter=0.04)
LATCHED = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
FREE, OCCUPIED, UNKNOWN = 0, 100, -1


class RadioLidar(Node):
    """A lidar on the robot (LaserScan on /scan, best effort): the run's seed decides how often it measures.

    That is each scan's `scan_time`. Like all lidars it turns a little unevenly.
    """

    def __init__(self) -> None:
        super().__init__("radio_lidar")
        self.publisher = self.create_publisher(LaserScan, "/scan", qos_profile_sensor_data)
        self.period = random.choice(PERIODS)
        self.create_timer(self.period, self.measure)

    def measure(self) -> None:
        """Measure one scan, and publish it."""
        scan = LaserScan(angle_min=-math.pi, angle_increment=math.tau / 8, range_min=0.1, range_max=5.0)
        early = Duration(seconds=random.uniform(0.0, UNEVEN) * self.period)
        scan.header.stamp, scan.header.frame_id = (self.get_clock().now() - early).to_msg(), "laser"
        scan.scan_time = self.period
        scan.ranges = [random.uniform(0.5, 4.0) for _ in range(8)]
        self.publisher.publish(scan)


class MapServer(Node):
    """Publishes a map (OccupancyGrid on /map, latched) before anybody else is there, and another at 5 s."""

    def __init__(self) -> None:
        super().__init__("map_server")
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.publisher = self.create_publisher(OccupancyGrid, "/map", latched)
        self.again = self.create_timer(5.0, self.change)
        self.publish()

    def change(self) -> None:
        """Publish another map, once."""
        self.again.cancel()
        self.publish()

    def publish(self) -> None:
        """Draw a map, and publish it."""
        grid = OccupancyGrid()
        grid.header.frame_id, grid.header.stamp = "map", self.get_clock().now().to_msg()
        grid.info.width, grid.info.height, grid.info.resolution = 10, 8, 0.5
        grid.data = random.choices((FREE, OCCUPIED, UNKNOWN), (random.uniform(2.0, 6.0), 2, 1), k=80)
        self.publisher.publish(grid)


class Visitor(Node):
    """Listens to /free (Int32, latched) from 3 s and from 7 s on, for 1 s; tells what comes on /receipt."""

    def __init__(self) -> None:
        super().__init__("visitor")
        self.publisher = self.create_publisher(Int32, "/receipt", 10)
        self.subscription = None
        self.ticks = 0
        self.create_timer(1.0, self.come_or_go)

    def come_or_go(self) -> None:
        """Make the subscription at 3 s and 7 s; a second later it goes again."""
        self.ticks += 1
        if self.subscription is not None:
            self.destroy_subscription(self.subscription)
            self.subscription = None
        if self.ticks in (3, 7):
            with contextlib.suppress(RuntimeError):  # it has another type: nothing is heard
                self.subscription = self.create_subscription(Int32, "/free", self.publisher.publish, LATCHED)
