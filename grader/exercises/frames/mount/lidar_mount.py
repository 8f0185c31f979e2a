"""Where a lidar is mounted on a robot."""

import random

from geometry_msgs.msg import Pose2D
from rclpy.node import Node

from grader.companions.qos import LATCHED


class Mechanic(Node):
    """Publishes the pose of a lidar on its robot once on /mounting (Pose2D), latched: drawn from the seed."""

    def __init__(self) -> None:
        super().__init__("mechanic")
        theta = random.choice((-1.0, 1.0)) * random.uniform(0.8, 2.4)
        pose = Pose2D(x=random.uniform(0.05, 0.2), y=random.uniform(-0.1, 0.1), theta=theta)
        self.publisher = self.create_publisher(Pose2D, "/mounting", LATCHED)
        self.publisher.publish(pose)
