"""Publishes velocity commands as Twist or, as most robots on Jazzy expect, TwistStamped."""

from __future__ import annotations

from geometry_msgs.msg import Twist, TwistStamped
from rclpy.node import Node


class VelocityPublisher:
    """A publisher on cmd_vel or another topic, of the type that the robot subscribes to.

    With `stamped` that is geometry_msgs/TwistStamped, with the current time and the frame base_link.
    """

    def __init__(self, node: Node, stamped: bool, topic: str = "cmd_vel") -> None:
        self._node, self._stamped = node, stamped
        self._publisher = node.create_publisher(TwistStamped if stamped else Twist, topic, 10)

    def send(self, forward: float, left: float) -> None:
        """Publish a velocity: m/s ahead, rad/s counter-clockwise."""
        command = Twist()
        command.linear.x, command.angular.z = forward, left
        if not self._stamped:
            self._publisher.publish(command)
            return
        message = TwistStamped(twist=command)
        message.header.stamp, message.header.frame_id = self._node.get_clock().now().to_msg(), "base_link"
        self._publisher.publish(message)
