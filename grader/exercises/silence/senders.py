"""Nodes of ours that send: a lidar over radio, and a map server with a visitor who comes late."""

from __future__ import annotations

import math
import random

from nav_msgs.msg import OccupancyGrid
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Int32

PERIODS = 0.08, 0.1, 0.16  # s between two scans
STEPS = 4  # a scan comes up to three quarters of a period after it was measured
UNEVEN = 0.2  # of a period; no lidar turns quite evenly
LOST, LONGEST = 0.12, 4  # of the scans a gap begins at so many; so many scans at most
LATCHED = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
FREE, OCCUPIED, UNKNOWN = 0, 100, -1


class RadioLidar(Node):
    """A lidar whose scans (LaserScan on /scan, best effort) come over radio: some are lost, all come late.

    The run's seed decides how often it measures, which is each scan's `scan_time`, and what gets lost.
    """

    def __init__(self) -> None:
        super().__init__("radio_lidar")
        self.publisher = self.create_publisher(LaserScan, "/scan", qos_profile_sensor_data)
        self.period = random.choice(PERIODS)
        self.ticks, self.gap = 0, 0
        self.waiting: list[tuple[int, LaserScan]] = []  # with the tick at which they arrive
        self.create_timer(self.period / STEPS, self.tick)

    def tick(self) -> None:
        """Measure at every fourth tick, and hand out what has arrived."""
        self.ticks += 1
        if self.ticks % STEPS == 0:
            self.measure(self.ticks // STEPS)
        while self.waiting and self.waiting[0][0] <= self.ticks:
            self.publisher.publish(self.waiting.pop(0)[1])

    def measure(self, number: int) -> None:
        """Measure one scan, which may get lost; the first three don't."""
        if not self.gap and number > 3 and random.random() < LOST:
            self.gap = random.randint(1, LONGEST)
        if self.gap:
            self.gap -= 1
            return
        scan = LaserScan(angle_min=-math.pi, angle_increment=math.tau / 8, range_min=0.1, range_max=5.0)
        early = Duration(seconds=random.uniform(0.0, UNEVEN) * self.period)
        scan.header.stamp, scan.header.frame_id = (self.get_clock().now() - early).to_msg(), "laser"
        scan.scan_time = self.period
        scan.ranges = [random.uniform(0.5, 4.0) for _ in range(8)]
        self.waiting.append((self.ticks + random.randrange(STEPS), scan))


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
            self.subscription = self.create_subscription(Int32, "/free", self.publisher.publish, LATCHED)
