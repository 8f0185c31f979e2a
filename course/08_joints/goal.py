"""An arm that draws: places become angles, angles become a path, and the path is the goal of an action."""

import math

from control_msgs.action import FollowJointTrajectory
from rclpy.action import ActionClient
from rclpy.duration import Duration
from rclpy.node import Node
from trajectory_msgs.msg import JointTrajectoryPoint

UPPER, FORE = 0.5, 0.4  # m, the lengths of upper arm and forearm


def inverse(x, y):
    """The angles (rad) of shoulder and elbow that bring the tip to a place (m)."""
    cosine = (x * x + y * y - UPPER**2 - FORE**2) / (2 * UPPER * FORE)
    if not -1 <= cosine <= 1:
        raise ValueError(f"({x:.2f}, {y:.2f}) is out of reach")
    elbow = math.acos(cosine)
    inside = math.atan2(FORE * math.sin(elbow), UPPER + FORE * math.cos(elbow))
    return math.atan2(y, x) - inside, elbow


def star(steps):
    """A star with five points as places (m), with so many steps on each of its lines."""
    corners = []
    for index in range(6):
        angle = 0.3 + index * 2 * math.tau / 5
        corners.append((0.48 + 0.25 * math.cos(angle), 0.38 + 0.25 * math.sin(angle)))
    places = corners[:1]
    for index in range(5):
        (x0, y0), (x1, y1) = corners[index], corners[index + 1]
        for step in range(1, steps + 1):
            part = step / steps
            places.append((x0 + part * (x1 - x0), y0 + part * (y1 - y0)))
    return places


class Artist(Node):
    """Draws one figure: 3 s to its first place, and then two seconds for each line of a star."""

    def __init__(self, steps=10):
        super().__init__("artist")
        self.client = ActionClient(self, FollowJointTrajectory, "/arm_controller/follow_joint_trajectory")
        self.goal = FollowJointTrajectory.Goal()
        self.goal.trajectory.joint_names = ["shoulder_joint", "elbow_joint"]
        for index, (x, y) in enumerate(star(steps)):
            point = JointTrajectoryPoint(positions=list(inverse(x, y)))
            point.time_from_start = Duration(seconds=3.0 + 2.0 * index / steps).to_msg()
            self.goal.trajectory.points.append(point)
        self.timer = self.create_timer(0.1, self.send)

    def send(self):
        """Send the goal as soon as the arm's server is there."""
        if self.client.server_is_ready():
            self.timer.cancel()
            self.client.send_goal_async(self.goal).add_done_callback(self.on_response)

    def on_response(self, future):
        """Ask for the result, if the arm goes."""
        if future.result().accepted:
            future.result().get_result_async().add_done_callback(self.on_result)
        else:
            self.get_logger().error("Rejected")

    def on_result(self, future):
        """Say how it ended."""
        self.get_logger().info(future.result().result.error_string)
