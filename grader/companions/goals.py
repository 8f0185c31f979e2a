"""Programs that send goals and plans to a navigator, and follow what becomes of them."""

from typing import Any, ClassVar

from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped
from nav2_msgs.action import NavigateToPose
from nav_msgs.msg import Path
from rclpy.action import ActionClient
from rclpy.node import Node

from grader.companions.map_messages import pose_stamped
from grader.geometry import Point
from grader.geometry.ground import drivable
from sim.world import World


class GoalSender(Node):
    """Sends goals as RViz' tool 2D Goal Pose does, one every 3 s: PoseStamped on /goal_pose."""

    goals: ClassVar[list[Point]]

    def __init__(self) -> None:
        super().__init__("goal_sender")
        self.publisher = self.create_publisher(PoseStamped, "/goal_pose", 10)
        self.left = list(self.goals)
        self.create_timer(3.0, self.send)

    def send(self) -> None:
        """Send the next one."""
        if self.left:
            self.publisher.publish(pose_stamped(Time(), *self.left.pop(0)))


class Planner(Node):
    """Publishes a path from the world's start to its goal once a second: nav_msgs/Path on /plan."""

    world: ClassVar[World]

    def __init__(self) -> None:
        super().__init__("planner_server")
        self.publisher = self.create_publisher(Path, "/plan", 10)
        self.path = Path(poses=[pose_stamped(Time(), x, y) for x, y in drivable(self.world)])
        self.path.header.frame_id = "map"
        self.create_timer(1.0, lambda: self.publisher.publish(self.path))


class GoalClient(Node):
    """Sends a robot to a goal with Nav2's action NavigateToPose, logs how far it is, and logs the result.

    cancel_after: seconds after which it cancels the goal, to send it again 2 s later.
    """

    goal: ClassVar[Point]
    cancel_after: ClassVar[float | None] = None

    def __init__(self) -> None:
        super().__init__("goal_client")
        self.client = ActionClient(self, NavigateToPose, "navigate_to_pose")
        self.patience = self.cancel_after
        self.reported = 0
        self.timer = self.create_timer(0.5, self.start)

    def start(self) -> None:
        """Send the goal, as soon as there is a server."""
        if not self.client.server_is_ready():
            return
        self.timer.cancel()
        goal = NavigateToPose.Goal(pose=pose_stamped(self.get_clock().now().to_msg(), *self.goal))
        future = self.client.send_goal_async(goal, feedback_callback=self.on_feedback)
        future.add_done_callback(self.on_response)

    def on_feedback(self, message: Any) -> None:
        """Log every few seconds how far it is."""
        feedback = message.feedback
        if feedback.navigation_time.sec >= self.reported + 5:
            self.reported = feedback.navigation_time.sec
            self.get_logger().info(f"{feedback.distance_remaining:.1f} m left after {self.reported} s")

    def on_response(self, future: Any) -> None:
        """Wait for the result, and for the time to cancel."""
        self.goal_handle = future.result()
        if not self.goal_handle.accepted:
            self.get_logger().warning("The goal was rejected.")
            return
        self.goal_handle.get_result_async().add_done_callback(self.on_result)
        if self.patience is not None:
            self.timer = self.create_timer(self.patience, self.cancel)
            self.patience = None

    def cancel(self) -> None:
        """Cancel the goal, and send it again later."""
        self.timer.cancel()
        self.goal_handle.cancel_goal_async()
        self.reported = 0
        self.timer = self.create_timer(2.0, self.start)

    def on_result(self, future: Any) -> None:
        """Log how it ended."""
        endings = {GoalStatus.STATUS_SUCCEEDED: "succeeded", GoalStatus.STATUS_CANCELED: "was canceled"}
        response = future.result()
        message = getattr(response.result, "error_msg", "")
        self.get_logger().info(f"The goal {endings.get(response.status, 'was aborted')}. {message}".strip())
