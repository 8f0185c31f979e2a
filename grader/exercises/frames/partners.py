"""What the nodes of 09_frames share: transforms, and a localization that knows where robots began."""

from __future__ import annotations

import math

from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import StaticTransformBroadcaster

from sim import World

Flat = tuple[float, float, float]  # x, y (m), yaw (rad)


def transform(parent: str, child: str, pose: Flat, stamp: Time | None = None) -> TransformStamped:
    """Where a frame is in its parent, on the floor."""
    sent = TransformStamped(child_frame_id=child)
    sent.header.frame_id, sent.header.stamp = parent, (stamp or Time()).to_msg()
    x, y, yaw = pose
    sent.transform.translation.x, sent.transform.translation.y = float(x), float(y)
    sent.transform.rotation.z, sent.transform.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return sent


def localization(world: World) -> list[type[Node]]:
    """A localization for a world: it says once where each robot's odom lies in the map."""

    class Localization(Node):
        """Static transforms from map to the odom of each robot: where it began."""

        def __init__(self) -> None:
            super().__init__("localization")
            self.broadcaster = StaticTransformBroadcaster(self)
            frames = {name: "odom" if name == "robot" else f"{name}/odom" for name in world.starts()}
            self.broadcaster.sendTransform(
                [transform("map", frames[name], pose) for name, pose in world.starts().items()]
            )

    return [Localization]
