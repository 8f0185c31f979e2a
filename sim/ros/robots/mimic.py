"""turtlesim's mimic: one turtle repeats the movements of another."""

from __future__ import annotations

import os

import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from turtlesim.msg import Pose

from sim import ros_environment


class Mimic(Node):
    """Turns input/pose (turtlesim/Pose) into output/cmd_vel (geometry_msgs/Twist): the same velocities."""

    def __init__(self) -> None:
        super().__init__("turtle_mimic")
        self._publisher = self.create_publisher(Twist, "output/cmd_vel", 1)
        self.create_subscription(Pose, "input/pose", self.on_pose, 1)

    def on_pose(self, pose: Pose) -> None:
        """Publish the same velocities."""
        command = Twist()
        command.linear.x, command.angular.z = pose.linear_velocity, pose.angular_velocity
        self._publisher.publish(command)


def main() -> None:
    """Mimic until Ctrl-C."""
    rclpy.init()
    try:
        rclpy.spin(Mimic())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    ros_environment.open_to_this_machine(int(os.environ.get("ROS_DOMAIN_ID", "0")))
    main()
