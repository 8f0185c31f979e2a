"""A robot that follows a leader, 1 m behind it, for the picture at the beginning."""

import math

import tf2_geometry_msgs  # noqa: F401 - with it, Buffer.transform knows points
from geometry_msgs.msg import PointStamped, TransformStamped, Twist
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, StaticTransformBroadcaster, TransformException, TransformListener

STARTS = {"odom": (-2.6, -1.8), "leader/odom": (-1.6, -1.8)}  # x and y in the map, m


class Localization(Node):
    """Says where both robots began."""

    def __init__(self):
        super().__init__("localization")
        self.broadcaster = StaticTransformBroadcaster(self)
        self.broadcaster.sendTransform([self.start(frame, *place) for frame, place in STARTS.items()])

    def start(self, frame, x, y):
        """The position of a frame in the map; it is not rotated."""
        sent = TransformStamped(child_frame_id=frame)
        sent.header.frame_id = "map"
        sent.transform.translation.x, sent.transform.translation.y = x, y
        sent.transform.rotation.w = 1.0
        return sent


class Shadow(Node):
    """Drives to the point 1 m behind the leader."""

    def __init__(self):
        super().__init__("shadow")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, self.follow)

    def follow(self):
        """Look up the point, and drive towards it; stop while there is no new transform."""
        point, command = PointStamped(), Twist()
        point.header.frame_id, point.point.x = "leader/base_link", -1.0
        try:
            found = self.buffer.transform(point, "base_link")
        except TransformException:
            found = PointStamped()
        goal, age = found.point, self.get_clock().now() - Time.from_msg(found.header.stamp)
        distance, angle = math.hypot(goal.x, goal.y), math.atan2(goal.y, goal.x)
        if distance > 0.1 and age < Duration(seconds=0.5):
            command.linear.x = min(0.4, 1.5 * distance) * max(0.0, math.cos(angle))
            command.angular.z = max(-1.5, min(1.5, 2.0 * angle))
        self.publisher.publish(command)
