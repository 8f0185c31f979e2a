"""A node written for another robot, which students connect to the course's."""

from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node


class OneMeter(Node):
    """Drives one meter straight on: Twist on `velocity` until Odometry on `pose` says that it's there.

    It was written for another robot, where the topics have these names.
    """

    def __init__(self) -> None:
        super().__init__("one_meter")
        self.x = 0.0  # meters, frame odom
        self.publisher = self.create_publisher(Twist, "velocity", 10)
        self.create_subscription(Odometry, "pose", self.on_pose, 10)
        self.create_timer(0.1, self.drive)

    def on_pose(self, msg: Odometry) -> None:
        """Remember how far the robot has come."""
        self.x = msg.pose.pose.position.x

    def drive(self) -> None:
        """Forward, until the meter is done."""
        msg = Twist()
        msg.linear.x = 0.3 if self.x < 0.97 else 0.0
        self.publisher.publish(msg)
