"""Filters of messages in the nodes of a run."""

import message_filters
from message_filters import ApproximateTimeSynchronizer, Cache, Subscriber
from nav_msgs.msg import Odometry
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String

from sim import run
from tests.ros_packages.test_message_filters import CACHE_WARNING, PAIR_WARNING


class Pairs(Node):
    """Combines odometry with scans, as tutorials do."""

    def __init__(self):
        super().__init__("pairs")
        self.odom = Subscriber(self, Odometry, "odom")
        self.scan = Subscriber(self, LaserScan, "scan", qos_profile=qos_profile_sensor_data)
        self.both = ApproximateTimeSynchronizer([self.odom, self.scan], queue_size=10, slop=0.05)
        self.both.registerCallback(self.combine)
        self.cache = Cache(self.scan, 5)
        self.create_timer(1.5, self.look_back)
        self.get_logger().info(f"{self.odom.getTopic()} {self.odom.topic_name} {self.scan.qos_profile.depth}")

    def combine(self, odom: Odometry, scan: LaserScan):
        apart = Time.from_msg(odom.header.stamp) - Time.from_msg(scan.header.stamp)
        self.get_logger().info(f"apart {abs(apart.nanoseconds) / 1e9:.2f}")

    def look_back(self):
        now = self.get_clock().now()
        scans = self.cache.getInterval(now - Duration(seconds=0.5), now)
        self.get_logger().info(f"{len(scans)} scans")


def test_filters_work_in_a_node():
    recording = run(Pairs, world="room", seconds=2, quiet=True)
    assert [error.says for error in recording.errors] == []
    lines = [line.text for line in recording.logs if line.node == "pairs"]
    assert lines[0] == "odom /odom 5"
    apart = [float(line.split()[1]) for line in lines if line.startswith("apart")]
    assert len(apart) >= 15
    assert max(apart) < 0.05
    assert "5 scans" in lines


class Headerless(Node):
    """Filters messages that have no header, first refused and then accepted."""

    def __init__(self):
        super().__init__("headerless")
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.source = Subscriber(self, String, "chatter")
        self.refusing = Cache(self.source)
        self.cache = Cache(self.source, allow_headerless=True)
        self.refusing_pair = ApproximateTimeSynchronizer([self.source, self.source], 5, 0.1)
        self.pair = ApproximateTimeSynchronizer([self.source, self.source], 5, 0.1, allow_headerless=True)
        self.pair.registerCallback(lambda *pair: self.get_logger().info(f"pair of {len(pair)}"))
        self.create_timer(0.5, self.send)
        self.create_timer(0.75, self.look)

    def send(self):
        self.publisher.publish(String(data="hello"))

    def look(self):
        assert self.refusing.getLast() is None
        stamp = self.cache.getLastestTime()
        self.get_logger().info(f"{self.cache.getLast().data} {stamp.nanoseconds % 10**9}")


def test_messages_without_a_header_are_refused_with_upstreams_warning_or_get_the_present_time():
    recording = run(Headerless, seconds=0.8, quiet=True)
    assert [error.says for error in recording.errors] == []
    assert [line.text for line in recording.logs if line.node == "headerless"] == [
        "pair of 2",
        "hello 500000000",
    ]
    warnings = {line.node: line.text for line in recording.logs if line.level == "WARN"}
    assert warnings == {"message_filters_cache": CACHE_WARNING, "message_filters_approx": PAIR_WARNING}


def test_a_wrong_argument_fails_as_upstream():
    class Wrong(Node):
        def __init__(self):
            super().__init__("wrong")
            self.sub = message_filters.Subscriber(self, String, "chatter", 5)

    [error] = run(Wrong, seconds=0.2, quiet=True).errors
    assert "multiple values for argument 'qos_profile'" in error.says
