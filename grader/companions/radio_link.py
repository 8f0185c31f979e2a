"""A radio link for scans, that may fall silent and get slow."""

import random

from rclpy.node import Node
from rclpy.time import Time
from sensor_msgs.msg import LaserScan

from sim.evidence import since_start


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
        """How many seconds the link takes at the moment."""
        return 0.0


class BadRadio(Radio):
    """As Radio; but after some 11 s it is silent for 3 s, and after 17 s its scans come 1 s late for 3 s."""

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
