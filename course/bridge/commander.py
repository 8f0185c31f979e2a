"""The calls of Nav2's simple commander that a tour needs, with Nav2's names."""

from enum import Enum

import rclpy
from action_msgs.msg import GoalStatus
from nav2_msgs.action import FollowWaypoints, NavigateToPose
from rclpy.action import ActionClient
from rclpy.node import Node


class TaskResult(Enum):
    """How a task ended."""

    UNKNOWN = 0
    SUCCEEDED = 1
    CANCELED = 2
    FAILED = 3


RESULTS = {
    GoalStatus.STATUS_SUCCEEDED: TaskResult.SUCCEEDED,
    GoalStatus.STATUS_CANCELED: TaskResult.CANCELED,
    GoalStatus.STATUS_ABORTED: TaskResult.FAILED,
}


class BasicNavigator(Node):
    """Sends one task at a time, and spins itself while it waits."""

    def __init__(self, node_name="basic_navigator", namespace=""):
        super().__init__(node_name, namespace=namespace)
        self.to_pose = ActionClient(self, NavigateToPose, "navigate_to_pose")
        self.waypoints = ActionClient(self, FollowWaypoints, "follow_waypoints")
        self.goal_handle = self.outcome = self.feedback = self.status = None

    def waitUntilNav2Active(self):
        """Wait for the navigator."""
        while not self.to_pose.wait_for_server(timeout_sec=1.0):
            self.get_logger().info("waiting for navigate_to_pose")

    def goToPose(self, pose, behavior_tree=""):
        """Request a drive to a pose; return whether it is accepted."""
        return self.start(self.to_pose, NavigateToPose.Goal(pose=pose, behavior_tree=behavior_tree))

    def followWaypoints(self, poses):
        """Request a drive to one pose after another; return whether it is accepted."""
        return self.start(self.waypoints, FollowWaypoints.Goal(poses=poses))

    def start(self, client, goal):
        """Send a goal, and wait for the response."""
        client.wait_for_server()
        self.outcome = self.feedback = self.status = None
        response = client.send_goal_async(goal, feedback_callback=self.on_feedback)
        rclpy.spin_until_future_complete(self, response)
        self.goal_handle = response.result()
        if self.goal_handle.accepted:
            self.outcome = self.goal_handle.get_result_async()
        return self.goal_handle.accepted

    def on_feedback(self, message):
        """Store the newest feedback."""
        self.feedback = message.feedback

    def isTaskComplete(self):
        """Spin for a tenth of a second at most; return whether the task has ended."""
        if self.outcome is None:
            return True
        rclpy.spin_until_future_complete(self, self.outcome, timeout_sec=0.1)
        if self.outcome.done():
            self.status = self.outcome.result().status
        return self.outcome.done()

    def getFeedback(self):
        """Return the newest feedback, or None."""
        return self.feedback

    def getResult(self):
        """Return how the task ended."""
        return RESULTS.get(self.status, TaskResult.UNKNOWN)

    def cancelTask(self):
        """Request that the task is canceled, and wait for the response."""
        if self.outcome is not None:
            rclpy.spin_until_future_complete(self, self.goal_handle.cancel_goal_async())
