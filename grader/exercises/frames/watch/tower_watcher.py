"""A program that turns a tower; students start it with the right parameters and remappings."""

import math

from geometry_msgs.msg import Twist
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, TransformException, TransformListener

WAITING = "Waiting"  # how its warnings about a missing frame begin


class Watcher(Node):
    """Turns a tower so that it always faces another robot.

    Its parameter `target` is that robot's name. It publishes on cmd_vel, like all nodes that drive.
    """

    def __init__(self) -> None:
        super().__init__("watcher")
        self.declare_parameter("target", "turtle2")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_timer(0.1, self.watch)

    def watch(self) -> None:
        """Turn towards the target; stop while its place isn't known."""
        target = f"{self.get_parameter('target').value}/base_link"
        command = Twist()
        try:
            found = self.buffer.lookup_transform("tower/base_link", target, Time())
        except TransformException as error:
            self.get_logger().warning(f"{WAITING}: {error}", throttle_duration_sec=1.0)
        else:
            if self.get_clock().now() - Time.from_msg(found.header.stamp) < Duration(seconds=0.5):
                place = found.transform.translation
                command.angular.z = max(-1.5, min(1.5, 2.0 * math.atan2(place.y, place.x)))
        self.publisher.publish(command)
