"""Nodes that move the arm: by positions, and by goals of its action."""

import math

import rclpy
from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from control_msgs.msg import JointTolerance
from rclpy.action import ActionClient
from rclpy.node import Node
from std_msgs.msg import Float64MultiArray
from trajectory_msgs.msg import JointTrajectoryPoint

STATUS = {value: name[7:] for name, value in vars(GoalStatus).items() if name.startswith("STATUS_")}
JOINTS = ["shoulder_joint", "elbow_joint"]


def point(seconds, positions, velocities=()):
    whole = math.floor(seconds)
    return JointTrajectoryPoint(
        positions=list(positions), velocities=list(velocities),
        time_from_start=Duration(sec=whole, nanosec=round((seconds - whole) * 1e9)),
    )  # fmt: skip


def goal(*points, names=JOINTS, path=(), end=(), patience=0.0):
    """A goal; path and end are (joint, radians), patience is in seconds."""
    message = FollowJointTrajectory.Goal()
    message.trajectory.joint_names = list(names)
    message.trajectory.points = list(points)
    message.path_tolerance = [JointTolerance(name=name, position=value) for name, value in path]
    message.goal_tolerance = [JointTolerance(name=name, position=value) for name, value in end]
    message.goal_time_tolerance = Duration(nanosec=round(patience * 1e9))
    return message


STEADY = goal(point(1.0, (0.5, -0.5), (0.4, 0.0)), point(2.0, (1.0, 0.0), (0.0, 0.0)))


class Follower(Node):
    """Sends its goals, each at its time, and says all that comes back, as tutorials of ROS 2 do."""

    def __init__(self, *goals, cancel_after=None):
        super().__init__("follower")
        self.client = ActionClient(self, FollowJointTrajectory, "/arm_controller/follow_joint_trajectory")
        self.client.wait_for_server()
        self.cancel_after = cancel_after
        for delay, message in goals or [(0.0, STEADY)]:
            if delay:
                self.later(delay, lambda message=message: self.send(message))
            else:
                self.send(message)

    def later(self, delay, call):
        def once():
            timer.cancel()
            call()

        timer = self.create_timer(delay, once)

    def say(self, text):
        self.get_logger().info(text)

    def send(self, message):
        future = self.client.send_goal_async(message, feedback_callback=self.on_feedback)
        future.add_done_callback(self.on_response)

    def on_feedback(self, message):
        pass

    def on_response(self, future):
        handle = future.result()
        self.say("accepted" if handle.accepted else "rejected")
        if handle.accepted:
            handle.get_result_async().add_done_callback(self.on_result)
            if self.cancel_after is not None:
                self.later(self.cancel_after, handle.cancel_goal_async)

    def on_result(self, future):
        answer = future.result()
        self.say(f"{STATUS[answer.status]} {answer.result.error_code} {answer.result.error_string}")


def following(*goals, cancel_after=None):
    """A program for each set of goals: (when, goal)."""

    def make():
        return Follower(*goals, cancel_after=cancel_after)

    return make


class Reporter(Follower):
    """Says the feedback too."""

    def on_feedback(self, message):
        feedback = message.feedback
        time = feedback.actual.time_from_start
        rows = [
            [round(value, 3) for value in (*one.positions, *one.velocities)]
            for one in (feedback.desired, feedback.actual, feedback.error)
        ]
        self.say(f"{time.sec + time.nanosec / 1e9:g} {list(feedback.joint_names)} {rows}")


def waiting_client():
    """Line by line, with spin_until_future_complete; then it ends."""
    rclpy.init()
    node = Node("client")
    client = ActionClient(node, FollowJointTrajectory, "/arm_controller/follow_joint_trajectory")
    client.wait_for_server()
    future = client.send_goal_async(STEADY)
    rclpy.spin_until_future_complete(node, future)
    future = future.result().get_result_async()
    rclpy.spin_until_future_complete(node, future)
    node.get_logger().info(future.result().result.error_string)
    node.destroy_node()
    rclpy.shutdown()


class Commander(Node):
    """Sends one list of positions at 0.5 s."""

    positions = (1.0, -0.5)

    def __init__(self):
        super().__init__("commander")
        self.publisher = self.create_publisher(Float64MultiArray, "/joint_commands", 10)
        self.timer = self.create_timer(0.5, self.send)

    def send(self):
        self.publisher.publish(Float64MultiArray(data=list(self.positions)))
        self.timer.cancel()


class ThreePositions(Commander):
    positions = (1.0, 2.0, 3.0)


class NoNumber(Commander):
    positions = (1.0, math.nan)


class ChangesItsMind(Follower):
    """Half a second on, sends another goal and cancels the first one in the same breath."""

    def __init__(self):
        super().__init__()
        self.later(0.5, self.change)

    def on_response(self, future):
        if not hasattr(self, "first"):
            self.first = future.result()
        super().on_response(future)

    def change(self):
        self.send(STEADY)
        self.first.cancel_goal_async().add_done_callback(
            lambda future: self.say(f"canceling {len(future.result().goals_canceling)}")
        )
