"""A latched map, and a visitor that subscribes late."""

import contextlib
import random

from nav_msgs.msg import OccupancyGrid
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.subscription import Subscription
from std_msgs.msg import Int32

from grader.companions.qos import LATCHED

MANY = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
FREE, OCCUPIED, UNKNOWN = 0, 100, -1


class LatchedMap(Node):
    """Publishes a map (OccupancyGrid on /map, latched) as the first node, and another at 5 s."""

    def __init__(self) -> None:
        super().__init__("map_server")
        self.publisher = self.create_publisher(OccupancyGrid, "/map", LATCHED)
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


class LateSubscriber(Node):
    """Listens to /free (Int32, latched) from 3 s and from 7 s on, for 1 s; republishes on /receipt."""

    def __init__(self) -> None:
        super().__init__("visitor")
        self.publisher = self.create_publisher(Int32, "/receipt", 10)
        self.subscription: Subscription | None = None
        self.ticks = 0
        self.create_timer(1.0, self.subscribe_or_leave)

    def subscribe_or_leave(self) -> None:
        """Subscribe at 3 s and 7 s, and unsubscribe a second later."""
        self.ticks += 1
        if self.subscription is not None:
            self.destroy_subscription(self.subscription)
            self.subscription = None
        if self.ticks in (3, 7):
            with contextlib.suppress(RuntimeError):  # another type: it receives nothing
                self.subscription = self.create_subscription(Int32, "/free", self.publisher.publish, MANY)
