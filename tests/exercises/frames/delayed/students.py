"""Nodes that wait for a transform: right ones, and wrong ones named by their defect."""

import rclpy
import tf2_geometry_msgs
from geometry_msgs.msg import PointStamped
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.duration import Duration
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, TransformException, TransformListener


class Patient(Node):
    """As one would write it; the wrong ones change one thing each."""

    def __init__(self):
        super().__init__("patient")
        self.buffer, self.waiting = Buffer(), []
        self.listener = TransformListener(self.buffer, self)
        self.publisher = self.create_publisher(PointStamped, "/found", 10)
        self.create_subscription(PointStamped, "/detection", self.on_message, 10)
        self.create_timer(0.05, self.look)

    def on_message(self, msg):
        self.waiting.append(msg)

    def look(self):
        while self.waiting and self.buffer.can_transform("map", "base_link", self.when(self.waiting[0])):
            self.publisher.publish(self.buffer.transform(self.waiting.pop(0), "map"))

    def when(self, msg):
        return Time.from_msg(msg.header.stamp)


class Awaiting(Patient):
    """With a coroutine for each of them."""

    def __init__(self):
        Node.__init__(self, "patient")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.publisher = self.create_publisher(PointStamped, "/found", 10)
        group = ReentrantCallbackGroup()
        self.create_subscription(PointStamped, "/detection", self.on_message, 10, callback_group=group)

    async def on_message(self, msg):
        found = await self.buffer.lookup_transform_async("map", "base_link", self.when(msg))
        moved = tf2_geometry_msgs.do_transform_point(msg, found)
        moved.header.stamp = msg.header.stamp
        self.publisher.publish(moved)


class ByFutures(Patient):
    """A design of its own: the buffer's future is done when the transform has come."""

    def on_message(self, msg):
        future = self.buffer.wait_for_transform_async("map", "base_link", self.when(msg))
        future.add_done_callback(lambda _: self.publisher.publish(self.buffer.transform(msg, "map")))


def main_with_threads():
    """Waits in the callback, while other threads receive."""
    rclpy.init()
    node = rclpy.create_node("patient")
    buffer = Buffer()
    node.listener = TransformListener(buffer, node)
    publisher = node.create_publisher(PointStamped, "/found", 10)

    def on_message(msg):
        publisher.publish(buffer.transform(msg, "map", timeout=Duration(seconds=1)))

    group = ReentrantCallbackGroup()
    node.create_subscription(PointStamped, "/detection", on_message, 10, callback_group=group)
    executor = MultiThreadedExecutor(num_threads=8)
    executor.add_node(node)
    executor.spin()


class AsksAtOnce(Patient):
    def on_message(self, msg):
        self.publisher.publish(self.buffer.transform(msg, "map"))


class GivesUp(Patient):
    def on_message(self, msg):
        try:
            self.publisher.publish(self.buffer.transform(msg, "map"))
        except TransformException as error:
            self.get_logger().info(str(error))


class Newest(Patient):
    def on_message(self, msg):
        found = self.buffer.lookup_transform("map", "base_link", Time())
        moved = tf2_geometry_msgs.do_transform_point(msg, found)
        moved.header.stamp = msg.header.stamp
        self.publisher.publish(moved)


class WaitsInTheCallback(Patient):
    def on_message(self, msg):
        try:
            self.publisher.publish(self.buffer.transform(msg, "map", timeout=Duration(seconds=1)))
        except TransformException as error:
            self.get_logger().info(str(error))


class AgainAndAgain(Patient):
    def look(self):
        for msg in self.waiting:
            if self.buffer.can_transform("map", "base_link", self.when(msg)):
                self.publisher.publish(self.buffer.transform(msg, "map"))


class Sluggish(Patient):
    """Looks every 0.4 s, and then at all of them."""

    def __init__(self):
        super().__init__()
        self.ticks = 0

    def look(self):
        self.ticks += 1
        if self.ticks % 8 == 0:
            super().look()


class StampedNow(Patient):
    def look(self):
        while self.waiting and self.buffer.can_transform("map", "base_link", self.when(self.waiting[0])):
            moved = self.buffer.transform(self.waiting.pop(0), "map")
            moved.header.stamp = self.get_clock().now().to_msg()
            self.publisher.publish(moved)


class Deaf(Patient):
    def __init__(self):
        Node.__init__(self, "patient")
        self.create_subscription(PointStamped, "/detection", self.on_message, 10)

    def on_message(self, msg):
        self.get_logger().info("received")


class Guesses(Patient):
    """Knows how the robot drove up to now, and where that would have led it."""

    def on_message(self, msg):
        newest = self.buffer.lookup_transform("map", "base_link", Time())
        before = self.buffer.lookup_transform("map", "base_link", self.when(newest) - Duration(seconds=0.2))
        steps = (self.when(msg) - self.when(newest)).nanoseconds / 0.2e9
        place, then = newest.transform.translation, before.transform.translation
        place.x, place.y = place.x + steps * (place.x - then.x), place.y + steps * (place.y - then.y)
        moved = tf2_geometry_msgs.do_transform_point(msg, newest)
        moved.header.stamp = msg.header.stamp
        self.publisher.publish(moved)
