"""Clients that give up in time: right ones, and wrong ones named by their defect."""


import rclpy
from action_msgs.msg import GoalStatus
from nav2_msgs.action import DriveOnHeading
from rclpy.action import ActionClient
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.task import Future


class Courier(Node):
    action, meters, speed, patience = "/drive_on_heading", 2.0, 0.4, 8.0

    def __init__(self):
        super().__init__("courier")
        self.client = ActionClient(self, DriveOnHeading, self.action)
        self.timer = self.create_timer(0.1, self.ask)

    def ask(self):
        if self.client.server_is_ready():
            self.timer.cancel()
            self.send()

    def send(self):
        goal = DriveOnHeading.Goal(speed=self.speed)
        goal.target.x = self.meters
        self.client.send_goal_async(goal).add_done_callback(self.on_response)

    def on_response(self, future):
        self.goal_handle = future.result()
        self.goal_handle.get_result_async().add_done_callback(self.on_result)
        self.timer = self.create_timer(self.patience, self.give_up)

    def give_up(self):
        self.timer.cancel()
        self.goal_handle.cancel_goal_async()

    def on_result(self, future):
        self.timer.cancel()
        answer = future.result()
        if answer.status == GoalStatus.STATUS_SUCCEEDED:
            self.get_logger().info("The robot has arrived.")
        else:
            self.get_logger().warning(f"It gave up: {answer.result.error_msg}")


class AwaitingCourier(Node):
    """A design of its own: a clock in place of a timer."""

    def __init__(self):
        super().__init__("courier")
        group = ReentrantCallbackGroup()
        self.client = ActionClient(self, DriveOnHeading, "drive_on_heading", callback_group=group)
        self.handle_, self.since = None, None
        self.once = self.create_timer(0.2, self.go, callback_group=group)
        self.create_timer(0.1, self.watch, callback_group=group)

    async def go(self):
        self.once.cancel()
        goal = DriveOnHeading.Goal(speed=0.4)
        goal.target.x = 2.0
        self.handle_ = await self.client.send_goal_async(goal)
        self.since = self.get_clock().now()
        answer = await self.handle_.get_result_async()
        self.since = None
        if answer.status == GoalStatus.STATUS_CANCELED:
            self.get_logger().warning(answer.result.error_msg)
        else:
            self.get_logger().info("arrived")

    def watch(self):
        if self.since and (self.get_clock().now() - self.since).nanoseconds > 8e9:
            self.since = None
            self.handle_.cancel_goal_async()


def main_that_waits_with_a_limit():
    rclpy.init()
    node = Node("courier")
    client = ActionClient(node, DriveOnHeading, "drive_on_heading")
    client.wait_for_server()
    goal = DriveOnHeading.Goal(speed=0.4)
    goal.target.x = 2.0
    sent = client.send_goal_async(goal)
    rclpy.spin_until_future_complete(node, sent)
    result = sent.result().get_result_async()
    rclpy.spin_until_future_complete(node, result, timeout_sec=8.0)
    if result.done():
        node.get_logger().info("Arrived!")
        return
    rclpy.spin_until_future_complete(node, sent.result().cancel_goal_async())
    rclpy.spin_until_future_complete(node, result)
    node.get_logger().warning(f"Gave up, {result.result().result.error_msg}.")


class NeverGivesUp(Courier):
    def on_response(self, future):
        self.goal_handle = future.result()
        self.goal_handle.get_result_async().add_done_callback(self.on_result)


class SendsNothing(Courier):
    def send(self):
        pass


class MisspeltName(Courier):
    action = "/drive_on_headings"

    def ask(self):
        self.timer.cancel()
        self.send()


class ForgetsTheTarget(Courier):
    def send(self):
        goal = DriveOnHeading.Goal(speed=0.4)
        self.client.send_goal_async(goal).add_done_callback(self.on_response)


class WholeNumber(Courier):
    def send(self):
        goal = DriveOnHeading.Goal(speed=0.4)
        goal.target.x = 2
        self.client.send_goal_async(goal).add_done_callback(self.on_response)


class Impatient(Courier):
    patience = 3.0


class GivesUpTooLate(Courier):
    patience = 12.0


class ForgetsTheTimerAtTheEnd(Courier):
    def on_result(self, future):
        timer, self.timer = self.timer, self.create_timer(100.0, lambda: None)
        super().on_result(future)
        self.timer = timer


class AnyResultIsArrived(Courier):
    def on_result(self, future):
        self.timer.cancel()
        self.get_logger().info("The robot has arrived.")


class SaysBoth(Courier):
    def on_result(self, future):
        super().on_result(future)
        self.get_logger().info("Arrived, or so.")


class StatusOfTheResult(Courier):
    """The status is beside the result, not in it."""

    def on_result(self, future):
        if future.result().result.status == GoalStatus.STATUS_SUCCEEDED:
            self.get_logger().info("arrived")


class ComparesWithTheErrorCode(Courier):
    """error_code stays 0 when someone cancels."""

    def on_result(self, future):
        self.timer.cancel()
        if future.result().result.error_code == 0:
            self.get_logger().info("arrived")
        else:
            self.get_logger().warning(future.result().result.error_msg)


def main_that_asks_and_ends():
    rclpy.init()
    rclpy.spin_until_future_complete(Courier(), Future(), timeout_sec=2.0)
    rclpy.shutdown()


class LogsItsWayQuietly(Courier):
    """Right, too: feedback is logged as debug, and once a second as info."""

    def send(self):
        goal = DriveOnHeading.Goal(speed=self.speed)
        goal.target.x = self.meters
        sent = self.client.send_goal_async(goal, feedback_callback=self.on_feedback)
        sent.add_done_callback(self.on_response)

    def on_feedback(self, msg):
        meters = msg.feedback.distance_traveled
        self.get_logger().debug(f"{meters:.3f} m")
        self.get_logger().info(f"{meters:.1f} m", throttle_duration_sec=1.0)
