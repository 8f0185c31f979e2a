"""Transforms of the course, and a localization that knows where robots began."""

import functools
import math
import random
from collections.abc import Callable

from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster

from grader.geometry import Pose2D
from sim import World
from sim.evidence import Seconds, since_start

LEADER = "leader/odom"
ENDS = 6.5, 9.5  # s; while the leader drives


def transform(parent: str, child: str, pose: Pose2D, stamp: Time | None = None) -> TransformStamped:
    """Return a transform in the plane; without a stamp, that of a static one."""
    sent = TransformStamped(child_frame_id=child)
    sent.header.frame_id, sent.header.stamp = parent, (stamp or Time()).to_msg()
    x, y, yaw = pose
    sent.transform.translation.x, sent.transform.translation.y = float(x), float(y)
    sent.transform.rotation.z, sent.transform.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return sent


class StaticLocalization(Node):
    """Publishes static transforms from map to the odom of each robot of a world: where it began.

    late: how long after its start it publishes them, as one that first has to find its robots.
    """

    def __init__(self, world: World, late: Seconds = 0.0) -> None:
        super().__init__("localization")
        self.broadcaster = StaticTransformBroadcaster(self)
        starts = {"odom" if name == "robot" else f"{name}/odom": p for name, p in world.starts().items()}
        self.transforms = [transform("map", frame, Pose2D(*start)) for frame, start in starts.items()]
        if late:
            self.timer = self.create_timer(late, self.publish_late)
        else:
            self.publish_static()

    def publish_late(self) -> None:
        """Publish the transforms, once."""
        self.timer.cancel()
        self.publish_static()

    def publish_static(self) -> None:
        """Publish all transforms."""
        self.broadcaster.sendTransform(self.transforms)


class LosesTheLeader(StaticLocalization):
    """Like StaticLocalization; but the leader's transform is sent ten times a second, for some 8 s."""

    def __init__(self, world: World) -> None:
        super().__init__(world)
        self.moving, self.ends = TransformBroadcaster(self), random.uniform(*ENDS)
        self.create_timer(0.1, self.publish_leader)

    def publish_static(self) -> None:
        """Publish all but the leader's."""
        self.broadcaster.sendTransform([sent for sent in self.transforms if sent.child_frame_id != LEADER])

    def publish_leader(self) -> None:
        """Publish where the leader's odom is now; after the end, nothing."""
        now = self.get_clock().now().to_msg()
        if since_start(now) < self.ends:
            [sent] = [sent for sent in self.transforms if sent.child_frame_id == LEADER]
            sent.header.stamp = now
            self.moving.sendTransform(sent)


def localization(world: World, late: Seconds = 0.0) -> list[Callable[[], Node]]:
    """Return the localization of a world, as companions of a run in it; `late` as in StaticLocalization."""
    return [functools.partial(StaticLocalization, world, late)]
