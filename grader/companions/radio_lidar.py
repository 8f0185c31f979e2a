"""A lidar whose scans cross a lossy network."""

import math
import random

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from sim import Network

PERIODS = 0.09, 0.14  # s between two scans: longer than scans can overtake each other
UNEVEN = 0.2  # of a period
RADIO = Network(loss=0.2, delay=0.05, jitter=0.04)


class RadioLidar(Node):
    """A lidar on the robot (LaserScan on /scan, best effort): the run's seed decides its period.

    The period is each scan's `scan_time`. Like all lidars it turns a little unevenly.
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
