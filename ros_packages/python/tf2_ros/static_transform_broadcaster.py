"""Tells all nodes where frames are that never move."""

from collections.abc import Iterable

from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile
from tf2_msgs.msg import TFMessage

from tf2_ros.transform_broadcaster import listed


class StaticTransformBroadcaster:
    """Publishes transforms on /tf_static. They are kept for all who come later, so once is enough."""

    def __init__(self, node: Node, qos: QoSProfile | int | None = None) -> None:
        """qos: a profile or a depth; without it, the last message is kept for latecomers."""
        latched = QoSProfile(
            depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL, history=HistoryPolicy.KEEP_LAST
        )
        self.pub_tf = node.create_publisher(TFMessage, "/tf_static", latched if qos is None else qos)
        self.net_message = TFMessage()
        self._children: set[str] = set()

    def sendTransform(self, transform: TransformStamped | Iterable[TransformStamped]) -> None:
        """Send one or several transforms, with all that were sent before: only the last message is kept.

        A frame that was sent before stays where it was, as upstream has it.
        """
        for one in listed(transform):
            if one.child_frame_id not in self._children:
                self._children.add(one.child_frame_id)
                self.net_message.transforms.append(one)
        self.pub_tf.publish(self.net_message)
