"""A callback can run before the object that it belongs to is complete (as in rclpy#1589 and tinynav#122)."""

import threading

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Filter:
    """Subtracts an offset from the numbers of a topic."""

    def __init__(self, node):
        self.subscription = node.create_subscription(Int32, "numbers", self.on_number, 10)
        self.offset = 3

    def on_number(self, message):
        self.last = message.data - self.offset


class CompleteFirst(Filter):
    """Subscribes as the last step."""

    def __init__(self, node):
        self.offset = 3
        self.subscription = node.create_subscription(Int32, "numbers", self.on_number, 10)


class Numbers(Node):
    """Publishes a number every millisecond."""

    def __init__(self):
        super().__init__("numbers")
        publisher = self.create_publisher(Int32, "numbers", 10)
        self.create_timer(0.001, lambda: publisher.publish(Int32(data=7)))


def attached(kind):
    """A main() that spins a node in a thread, and gives it filters meanwhile."""

    def main():
        rclpy.init()
        node = Node("filters")
        threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
        filters = []
        for _ in range(5):
            node.get_clock().sleep_for(rclpy.duration.Duration(seconds=0.1))
            filters.append(kind(node))

    return main


SECONDS = 0.6
WRONG, RIGHT = (attached(Filter), Numbers), (attached(CompleteFirst), Numbers)
