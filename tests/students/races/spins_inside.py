"""A helper spins the node in whose callback it is called (as in navigation2#5948 and rclpy#1608)."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Localizer(Node):
    """Needs a map number for each scan number, and waits for it by spinning."""

    def __init__(self):
        super().__init__("localizer")
        self.map, self.scans = 0, []
        self.create_subscription(Int32, "map", self.on_map, 10)
        self.create_subscription(Int32, "scan", self.on_scan, 10)

    def on_map(self, message):
        self.map = message.data

    def on_scan(self, message):
        while self.map < message.data and rclpy.ok():
            rclpy.spin_once(self, timeout_sec=0.1)
        self.scans.append(message.data)
        assert self.scans == sorted(self.scans), self.scans


class Stores(Localizer):
    """Stores the scans until their map is there, and returns."""

    def __init__(self):
        super().__init__()
        self.stored = []

    def on_map(self, message):
        super().on_map(message)
        self.use()

    def on_scan(self, message):
        self.stored.append(message.data)
        self.use()

    def use(self):
        while self.stored and self.stored[0] <= self.map:
            self.scans.append(self.stored.pop(0))
        assert self.scans == sorted(self.scans), self.scans


class Sensors(Node):
    """Publishes a map and a scan at the same time, 20 times a second."""

    def __init__(self):
        super().__init__("sensors")
        self.number = 0
        self.both = [self.create_publisher(Int32, topic, 10) for topic in ("map", "scan")]
        self.create_timer(0.05, self.tick)

    def tick(self):
        self.number += 1
        for publisher in self.both:
            publisher.publish(Int32(data=self.number))


def holds(run):
    """Nothing fails, and scans are taken until the end."""
    taken = [call.stamp for call in run.callbacks if call.callback.endswith("on_scan")]
    return not run.errors and bool(taken) and taken[-1] > run.stamp - 0.2


WRONG, RIGHT = (Localizer, Sensors), (Stores, Sensors)
