"""Nodes that count lost scans: right ones, and wrong ones named by their defect."""

import rclpy
from rclpy.node import Node
from rclpy.qos import HistoryPolicy, QoSProfile, ReliabilityPolicy, qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Int32


class Counter(Node):
    """As one would write it; the wrong ones change one thing each."""

    qos = qos_profile_sensor_data

    def __init__(self):
        super().__init__("counter")
        self.missed, self.before = 0, None
        self.publisher = self.create_publisher(Int32, "/missed", 10)
        self.create_subscription(LaserScan, "/scan", self.on_message, self.qos)

    def on_message(self, scan):
        now = self.when(scan)
        if self.before is not None:
            self.missed += self.lost(now - self.before, scan)
        self.before = now
        self.publisher.publish(Int32(data=self.missed))

    def when(self, scan):
        return Time.from_msg(scan.header.stamp).nanoseconds / 1e9

    def lost(self, gap, scan):
        return round(gap / scan.scan_time) - 1


class OwnProfile(Counter):
    """Writes the profile out."""

    qos = QoSProfile(history=HistoryPolicy.KEEP_LAST, depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)

    def when(self, scan):
        return scan.header.stamp.sec + scan.header.stamp.nanosec * 1e-9


class FromTheFirst(Counter):
    """A design of its own: counts what should have come since the first scan."""

    first, came = None, 0

    def on_message(self, scan):
        now = self.when(scan)
        self.first = now if self.first is None else self.first
        self.came += 1
        due = round((now - self.first) / scan.scan_time) + 1
        self.publisher.publish(Int32(data=due - self.came))


def main_without_a_class():
    rclpy.init()
    node = rclpy.create_node("counter")
    publisher = node.create_publisher(Int32, "/missed", 10)
    stamps, missed = [], []

    def on_message(scan):
        stamps.append(Time.from_msg(scan.header.stamp))
        if len(stamps) > 1:
            missed.append(round((stamps[-1] - stamps[-2]).nanoseconds * 1e-9 / scan.scan_time) - 1)
        publisher.publish(Int32(data=sum(missed)))

    node.create_subscription(LaserScan, "/scan", on_message, qos_profile_sensor_data)
    rclpy.spin(node)


class Reliable(Counter):
    qos = 10


class ReliableProfile(Counter):
    qos = QoSProfile(depth=5, reliability=ReliabilityPolicy.RELIABLE)


class ForgetsLongGaps(Counter):
    def lost(self, gap, scan):
        return int(gap > 1.5 * scan.scan_time)


class CountsOneTooMany(Counter):
    def lost(self, gap, scan):
        return round(gap / scan.scan_time)


class CountsWhatCame(Counter):
    def lost(self, gap, scan):
        return 1


class ByArrival(Counter):
    def when(self, scan):
        return self.get_clock().now().nanoseconds / 1e9


class TenATime(Counter):
    """Believes that all lidars measure ten times a second."""

    def lost(self, gap, scan):
        return round(gap / 0.1) - 1


class OnlyTheLastGap(Counter):
    def on_message(self, scan):
        self.missed = 0
        super().on_message(scan)


class AlwaysZero(Counter):
    def lost(self, gap, scan):
        return 0


class OnlyWhenLost(Counter):
    def on_message(self, scan):
        before = self.missed
        publisher, self.publisher = self.publisher, self
        super().on_message(scan)
        self.publisher = publisher
        if self.missed > before:
            publisher.publish(Int32(data=self.missed))

    def publish(self, msg):
        pass


class LagsBehind(Counter):
    """Adds what was lost at the next scan only."""

    pending = 0

    def lost(self, gap, scan):
        pending, self.pending = self.pending, super().lost(gap, scan)
        return pending


class SaysItATenthLater(Counter):
    def __init__(self):
        super().__init__()
        self.outlet, self.publisher, self.waiting = self.publisher, self, []
        self.create_timer(0.01, self.look)

    def publish(self, msg):
        self.waiting.append((self.get_clock().now().nanoseconds + 1e8, msg))

    def look(self):
        while self.waiting and self.waiting[0][0] <= self.get_clock().now().nanoseconds:
            self.outlet.publish(self.waiting.pop(0)[1])


class OtherTopic(Counter):
    def __init__(self):
        Node.__init__(self, "counter")
        self.missed, self.before = 0, None
        self.publisher = self.create_publisher(Int32, "/missed", 10)
        self.create_subscription(LaserScan, "/lidar", self.on_message, self.qos)


class ListensOnce(Counter):
    """Receives one scan, publishes 0, and destroys its subscription: nothing can get lost any more."""

    def on_message(self, scan):
        super().on_message(scan)
        for subscription in list(self.subscriptions):
            self.destroy_subscription(subscription)
