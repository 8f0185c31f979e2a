"""Robots on a map, whose cameras see things and publish them a little later."""

import math
import random

from geometry_msgs.msg import PointStamped
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster

from grader.companions.transforms import transform
from grader.geometry import Pose2D
from sim.evidence import since_start

BEGIN, PAUSE = 2.0, 0.5  # s; the first sighting, and from one to the next
CAMERAS = {
    "robot1": Pose2D(0.2, 0.0, 0.5),
    "robot2": Pose2D(-0.1, 0.1, -1.2),
    "island": Pose2D(0.0, 0.0, 0.0),
}
# How old each sighting is (s), and which robot's it is. "ghost" is in no tree, "island" in another one. The
# run's seed decides on their order, and on all the robots' names.
SIGHTINGS = (
    (0.6, "robot1"),
    (1.2, "robot2"),
    (0.5, "ghost"),
    (0.9, "robot2"),
    (60.0, "robot1"),  # before any transform: an ExtrapolationException
    (0.7, "island"),
)
NAMES = [f"robot{number}" for number in range(1, 10)]


class Team(Node):
    """Publishes the poses of robots (/tf), of their cameras (/tf_static), and their sightings (/sighting)."""

    def __init__(self) -> None:
        super().__init__("team")
        self.moving, self.static = TransformBroadcaster(self), StaticTransformBroadcaster(self)
        self.publisher = self.create_publisher(PointStamped, "/sighting", 10)
        self.phase = random.uniform(-3.0, 3.0)
        self.count, self.plan = 0, random.sample(SIGHTINGS, len(SIGHTINGS))
        self.names = dict(zip((*CAMERAS, "ghost"), random.sample(NAMES, len(CAMERAS) + 1), strict=True))
        self.static.sendTransform([
            transform(f"{self.names[robot]}/base_link", f"{self.names[robot]}/camera", camera)
            for robot, camera in CAMERAS.items()
        ])
        self.create_timer(0.05, self.move)
        self.begin = self.create_timer(BEGIN, self.start)

    def start(self) -> None:
        """Begin with the sightings."""
        self.begin.cancel()
        self.create_timer(PAUSE, self.see)

    def move(self) -> None:
        """Publish where all robots are."""
        now = self.get_clock().now()
        maps = {robot: "sea" if robot == "island" else "map" for robot in CAMERAS}
        self.moving.sendTransform([
            transform(maps[robot], f"{self.names[robot]}/base_link", self.pose_at(robot, now), now)
            for robot in CAMERAS
        ])

    def pose_at(self, robot: str, now: Time) -> Pose2D:
        """Return the pose of a robot, each on a circle of its own."""
        angle = self.phase + 0.8 * since_start(now.to_msg()) + len(robot) + 2.0 * (robot == "robot2")
        return Pose2D(3.0 * math.cos(angle), 2.0 * math.sin(angle), math.remainder(angle + 1.5, math.tau))

    def see(self) -> None:
        """Publish the next sighting: a point in the frame of a camera, and when it was there."""
        age, robot = self.plan[self.count % len(SIGHTINGS)]
        self.count += 1
        point = PointStamped()
        point.header.stamp = (self.get_clock().now() - Duration(seconds=age)).to_msg()
        point.header.frame_id = f"{self.names[robot]}/camera"
        point.point.x, point.point.y = random.uniform(0.5, 2.0), random.uniform(-1.0, 1.0)
        self.publisher.publish(point)
