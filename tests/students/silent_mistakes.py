"""Programs that ROS lets do nothing without a word, named by their mistake; and right ones beside them."""

import threading

import message_filters
import rclpy
from geometry_msgs.msg import PointStamped, TransformStamped
from rclpy.duration import Duration
from rclpy.node import Node
from sensor_msgs.msg import LaserScan
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster


class Pairs(Node):
    """Right: it pairs points and scans, which it publishes itself, by their stamps."""

    def __init__(self):
        super().__init__("pairs")
        inputs = [
            message_filters.Subscriber(self, PointStamped, "/point"),
            message_filters.Subscriber(self, LaserScan, "/scan"),
        ]
        self.filter = self.make_filter(inputs)
        self.filter.registerCallback(self.on_pair)
        self.points = self.create_publisher(PointStamped, "/point", 10)
        self.scans = self.create_publisher(LaserScan, "/scan", 10)
        self.create_timer(0.1, self.send)

    def make_filter(self, inputs):
        return message_filters.TimeSynchronizer(inputs, 10)

    def send(self):
        self.publish(self.get_clock().now(), self.get_clock().now())

    def publish(self, of_point, of_scan):
        point, scan = PointStamped(), LaserScan()
        if of_point is not None:
            point.header.stamp = of_point.to_msg()
        scan.header.stamp = of_scan.to_msg()
        self.points.publish(point)
        self.scans.publish(scan)

    def on_pair(self, point, scan):
        pass


class NeverStamps(Pairs):
    def send(self):
        self.publish(None, self.get_clock().now())


class StampsApart(Pairs):
    def send(self):
        now = self.get_clock().now()
        self.publish(now, now - Duration(seconds=0.03))


class StampsFurtherApartThanTheSlop(StampsApart):
    def make_filter(self, inputs):
        return message_filters.ApproximateTimeSynchronizer(inputs, 10, 0.01)


class HasOneInput(Pairs):
    """Right: its scans come from another program, which isn't there."""

    def send(self):
        point = PointStamped()
        point.header.stamp = self.get_clock().now().to_msg()
        self.points.publish(point)


class TakesNoMessage(Pairs):
    def on_pair(self):
        pass


class TakesOneMessage(Pairs):
    def on_pair(self, point):
        pass


class TakesThreeMessages(Pairs):
    def on_pair(self, point, scan, image):
        pass


class TakesOneMessageInALambda(Pairs):
    def __init__(self):
        super().__init__()
        self.filter.registerCallback(lambda point: point)


class FiltersWithoutANode(Node):
    def __init__(self):
        super().__init__("pairs")
        message_filters.Subscriber(LaserScan, "/scan")


class FiltersInAnotherOrder(Node):
    def __init__(self):
        super().__init__("pairs")
        message_filters.Subscriber(LaserScan, "/scan", self)


class Localizer(Node):
    """Right: it sends one transform, ten times a second."""

    name, parent, child = "localizer", "map", "odom"
    broadcaster = TransformBroadcaster

    def __init__(self):
        super().__init__(self.name)
        self.sender = self.broadcaster(self)
        self.create_timer(0.1, self.send)

    def is_on(self, now):
        return True

    def send(self):
        if self.is_on(self.get_clock().now().nanoseconds % 10**11 / 1e9):
            transform = TransformStamped()
            transform.header.frame_id, transform.child_frame_id = self.parent, self.child
            transform.transform.rotation.w = 1.0
            self.stamp(transform)
            self.sender.sendTransform(transform)

    def stamp(self, transform):
        transform.header.stamp = self.get_clock().now().to_msg()


class NeverStampsTransforms(Localizer):
    def stamp(self, transform):
        pass


class SendsStatically(NeverStampsTransforms):
    """Right: a static transform holds at any time."""

    broadcaster = StaticTransformBroadcaster


class OtherLocalizer(Localizer):
    name = "other_localizer"


class LocalizerInTheWorld(OtherLocalizer):
    parent = "world"


class LocalizerOfAnotherRobot(OtherLocalizer):
    child = "robot2/odom"


class Predecessor(Localizer):
    """Right: it stops before its successor begins."""

    name = "predecessor"

    def is_on(self, now):
        self.begin = getattr(self, "begin", now)
        return now - self.begin < 1.0


class Successor(Localizer):
    name = "successor"

    def is_on(self, now):
        self.begin = getattr(self, "begin", now)
        return now - self.begin > 1.5


def sleeps_in_its_only_thread():
    rclpy.init()
    node = Node("sleeper")
    rate = node.create_rate(10)
    while rclpy.ok():
        rate.sleep()


def sleeps_beside_its_spinning_thread():
    """Right: a thread spins the node."""
    rclpy.init()
    node = Node("sleeper")
    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
    rate = node.create_rate(10)
    while rclpy.ok():
        rate.sleep()


class SleepsInACallback(Node):
    def __init__(self):
        super().__init__("sleeper")
        self.rate = self.create_rate(10)
        self.create_timer(0.5, self.work)

    def work(self):
        for _ in range(3):
            self.rate.sleep()


def _logs(node):
    node.create_timer(0.5, lambda: node.get_logger().info("I am here"))
    rclpy.spin(node)


def destroys_a_namesake():
    rclpy.init()
    first, second = Node("twin"), Node("twin")
    first.destroy_node()
    _logs(second)


def makes_its_node_again():
    """Right: the first one is gone before the second one comes."""
    rclpy.init()
    Node("twin").destroy_node()
    _logs(Node("twin"))
