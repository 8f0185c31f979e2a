"""Broadcasts the transforms of static frames."""

from collections.abc import Iterable

from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile
from tf2_msgs.msg import TFMessage

from tf2_ros.transform_broadcaster import as_list


class StaticTransformBroadcaster:
    """Publishes transforms on /tf_static. They are latched for later subscribers, so publish each once."""

    def __init__(self, node: Node, qos: QoSProfile | int | None = None) -> None:
        """qos: a profile or a depth; by default, the last message is latched."""
        latched = QoSProfile(
            depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL, history=HistoryPolicy.KEEP_LAST
        )
        self.pub_tf = node.create_publisher(TFMessage, "/tf_static", latched if qos is None else qos)
        self.net_message = TFMessage()
        self._children: set[str] = set()

    def sendTransform(self, transform: TransformStamped | Iterable[TransformStamped]) -> None:
        """Publish one or several transforms together with all earlier ones: only the last message is latched.

        A frame that was published before keeps its first transform, as with upstream.
        """
        for one in as_list(transform):
            if one.child_frame_id not in self._children:
                self._children.add(one.child_frame_id)
                self.net_message.transforms.append(one)
        self.pub_tf.publish(self.net_message)
