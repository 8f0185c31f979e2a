"""A lidar whose scans cross a lossy network, and a radio link for scans that may fall silent or get slow."""

import math
import random

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import LaserScan

from sim import Network
from sim.evidence import since_start

PERIODS = 0.09, 0.14  # s between two scans: longer than scans can overtake each other
UNEVEN = 0.2  # of a period
RADIO = Network(loss=0.2, delay=0.05, jitter=0.04)
WIFI = Network(delay=0.05, jitter=0.04)  # s; between the robot and a laptop near it, where nothing is lost


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


class Radio(Node):
    """The radio link that brings the robot's scans from /scan to /lidar. All is well with this one."""

    def __init__(self) -> None:
        super().__init__("radio")
        self.publisher = self.create_publisher(LaserScan, "/lidar", 10)
        self.waiting: list[LaserScan] = []
        self.create_subscription(LaserScan, "/scan", self.relay, 10)

    def relay(self, msg: LaserScan) -> None:
        """Pass the scans on that have waited as long as the link takes now."""
        now = self.get_clock().now()
        self.waiting.append(msg)
        delay = self.delay(since_start(now.to_msg()))
        while self.waiting and (now - Time.from_msg(self.waiting[0].header.stamp)).nanoseconds >= delay * 1e9:
            self.publisher.publish(self.waiting.pop(0))

    def delay(self, now: float) -> float:
        """Return how many seconds the link takes at the moment."""
        return 0.0


class BadRadio(Radio):
    """Like Radio, but silent for 3 s after some 11 s; from 17 s on, its scans are 1 s late for 3 s."""

    def __init__(self) -> None:
        super().__init__()
        self.silent, self.late = random.uniform(10.5, 11.5), random.uniform(16.5, 17.5)

    def relay(self, msg: LaserScan) -> None:
        """Nothing in the silence; what was said in it is lost."""
        if not self.silent < since_start(self.get_clock().now().to_msg()) < self.silent + 3.0:
            super().relay(msg)

    def delay(self, now: float) -> float:
        """One second, while the link is slow."""
        return 1.0 if self.late < now < self.late + 3.0 else 0.0
