"""Tells all nodes where moving frames are."""

from collections.abc import Iterable

from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from rclpy.qos import QoSProfile
from tf2_msgs.msg import TFMessage


class TransformBroadcaster:
    """Publishes transforms on /tf. They are not kept for latecomers: send them again and again."""

    def __init__(self, node: Node, qos: QoSProfile | int | None = None) -> None:
        """qos: a profile or a depth; without it, reliable with depth 100."""
        self.pub_tf = node.create_publisher(TFMessage, "/tf", QoSProfile(depth=100) if qos is None else qos)

    def sendTransform(self, transform: TransformStamped | Iterable[TransformStamped]) -> None:
        """Send one transform, or several in one message."""
        self.pub_tf.publish(TFMessage(transforms=listed(transform)))


def listed(transform: TransformStamped | Iterable[TransformStamped]) -> list[TransformStamped]:
    """One or several transforms as a list."""
    return list(transform) if hasattr(transform, "__iter__") else [transform]
