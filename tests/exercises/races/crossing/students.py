"""Clients of /drive_on_heading: right ones, and wrong ones named after their defect."""

import contextlib
import threading

import rclpy
from action_msgs.msg import GoalStatus
from geometry_msgs.msg import Twist
from nav2_msgs.action import DriveOnHeading
from rclpy.action import ActionClient
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty, Float64, String

STATES = {
    GoalStatus.STATUS_SUCCEEDED: "succeeded",
    GoalStatus.STATUS_CANCELED: "canceled",
    GoalStatus.STATUS_ABORTED: "aborted",
}

PARTS = ("_Attempt",)


class Commander(Node):
    """As one would write it; the wrong ones change one thing each."""

    speed, patience = 0.25, 0.6

    def __init__(self):
        super().__init__("commander")
        self.client = ActionClient(self, DriveOnHeading, "/drive_on_heading")
        self.commands = self.create_publisher(Twist, "/commander/cmd_vel", 10)
        self.states = self.create_publisher(String, "/state", 10)
        self.number = 0
        self.goal = None
        self.stop_requested = self.waiting = False
        self.last_news = self.get_clock().now()
        self.create_subscription(Float64, "/distance", self.on_distance, 10)
        self.create_subscription(Empty, "/stop", self.on_stop, 10)
        self.create_timer(0.1, self.watch)

    def publish_state(self, state):
        self.states.publish(String(data=state))

    def on_distance(self, msg):
        self.number += 1
        number = self.number
        self.goal, self.stop_requested, self.waiting = None, False, True
        self.last_news = self.get_clock().now()
        goal = DriveOnHeading.Goal(speed=self.speed)
        goal.target.x = msg.data
        future = self.client.send_goal_async(goal, feedback_callback=lambda _: self.on_feedback(number))
        future.add_done_callback(lambda future: self.on_response(number, future.result()))

    def on_feedback(self, number):
        if number == self.number:
            self.last_news = self.get_clock().now()

    def on_response(self, number, handle):
        if number != self.number:
            return
        self.goal = handle
        self.last_news = self.get_clock().now()
        self.publish_state("driving")
        result = handle.get_result_async()
        result.add_done_callback(lambda future: self.on_result(number, future.result().status))
        if self.stop_requested:
            handle.cancel_goal_async()

    def on_stop(self, msg):
        self.stop_requested = True
        if self.goal is not None:
            self.goal.cancel_goal_async()

    def on_result(self, number, status):
        if number == self.number:
            self.end(STATES.get(status, "lost"))

    def end(self, state):
        self.goal, self.waiting = None, False
        self.number += 1
        self.commands.publish(Twist())
        self.publish_state(state)

    def watch(self):
        silence = (self.get_clock().now() - self.last_news).nanoseconds / 1e9
        if self.waiting and silence > self.patience:
            self.end("lost")


class NumbersByFuture(Commander):
    """The future of the newest request says which goal counts."""

    def on_distance(self, msg):
        goal = DriveOnHeading.Goal(speed=self.speed)
        goal.target.x = msg.data
        self.goal, self.stop_requested, self.waiting = None, False, True
        self.last_news = self.get_clock().now()
        newest = self.newest = self.client.send_goal_async(goal, feedback_callback=self.on_any_feedback)
        newest.add_done_callback(self.on_accepted)

    def on_any_feedback(self, msg):
        self.last_news = self.get_clock().now()

    def on_accepted(self, future):
        if future is self.newest:
            self.on_response(self.number, future.result())

    def on_result(self, number, status):
        if number == self.number and self.goal.status == status:
            self.end(STATES[status])


class CancelsTheOlder(Commander):
    """It cancels the older goal before it sends the newer one."""

    def on_distance(self, msg):
        if self.goal is not None:
            self.goal.cancel_goal_async()
        super().on_distance(msg)


class DrivingAtOnce(Commander):
    """Its state is "driving" as soon as the goal was sent."""

    def on_distance(self, msg):
        super().on_distance(msg)
        self.publish_state("driving")


class RepeatsZeros(Commander):
    """It publishes zeros and its state all the time."""

    state = "idle"

    def publish_state(self, state):
        self.state = state
        super().publish_state(state)

    def watch(self):
        super().watch()
        super().publish_state(self.state)
        if not self.waiting:
            self.commands.publish(Twist())


class _Attempt:
    """One goal, from its request to its end."""

    def __init__(self, node, meters):
        self.node, self.handle, self.stop_requested, self.silence = node, None, False, 0
        goal = DriveOnHeading.Goal(speed=0.25)
        goal.target.x = meters
        future = node.client.send_goal_async(goal, feedback_callback=self.on_feedback)
        future.add_done_callback(self.on_response)

    def on_feedback(self, _):
        self.silence = 0

    def on_response(self, future):
        self.handle, self.silence = future.result(), 0
        self.handle.get_result_async().add_done_callback(self.on_result)
        self.node.publish(self, "driving")
        if self.stop_requested:
            self.handle.cancel_goal_async()

    def stop(self):
        self.stop_requested = True
        if self.handle is not None:
            self.handle.cancel_goal_async()

    def on_result(self, future):
        self.node.publish(self, STATES[future.result().status])


class Attempts(Node):
    """A design of its own: an object for each goal; the node listens to the newest only."""

    def __init__(self):
        super().__init__("commander")
        self.client = ActionClient(self, DriveOnHeading, "/drive_on_heading")
        self.commands = self.create_publisher(Twist, "/commander/cmd_vel", 10)
        self.states = self.create_publisher(String, "/state", 10)
        self.attempt = None
        self.create_subscription(Float64, "/distance", self.on_distance, 10)
        self.create_subscription(Empty, "/stop", self.on_stop, 10)
        self.create_timer(0.1, self.watch)

    def on_distance(self, msg):
        self.attempt = _Attempt(self, msg.data)

    def on_stop(self, msg):
        if self.attempt is not None:
            self.attempt.stop()

    def publish(self, attempt, state):
        if attempt is self.attempt:
            self.states.publish(String(data=state))
            if state != "driving":
                self.commands.publish(Twist())
                self.attempt = None

    def watch(self):
        if self.attempt is not None:
            self.attempt.silence += 1
            if self.attempt.silence > 6:
                self.publish(self.attempt, "lost")


class Coroutines(Commander):
    """A design of its own: a coroutine for each goal awaits its response and its result."""

    def on_distance(self, msg):
        self.number += 1
        self.goal, self.stop_requested, self.waiting = None, False, True
        self.last_news = self.get_clock().now()
        self.executor.create_task(self.drive, self.number, msg.data)

    async def drive(self, number, meters):
        goal = DriveOnHeading.Goal(speed=self.speed)
        goal.target.x = meters
        handle = await self.client.send_goal_async(goal, feedback_callback=lambda _: self.on_feedback(number))
        if number != self.number:
            return
        self.goal, self.last_news = handle, self.get_clock().now()
        self.publish_state("driving")
        if self.stop_requested:
            handle.cancel_goal_async()
        response = await handle.get_result_async()
        self.on_result(number, response.status)


class OneShot(Commander):
    """A design of its own: a timer that each sign of life resets."""

    def __init__(self):
        super().__init__()
        self.timer = self.create_timer(0.7, self.on_silence)
        self.timer.cancel()

    def on_distance(self, msg):
        super().on_distance(msg)
        self.timer.reset()

    def on_feedback(self, number):
        if number == self.number:
            self.timer.reset()

    def on_response(self, number, handle):
        if number == self.number:
            self.timer.reset()
        super().on_response(number, handle)

    def watch(self):
        pass

    def on_silence(self):
        self.timer.cancel()
        if self.waiting:
            self.end("lost")


class AlsoAsksTheGraph(Commander):
    """The silence decides; a server that is gone is noticed earlier."""

    def watch(self):
        if self.waiting and not self.client.server_is_ready():
            self.end("lost")
        super().watch()


class Locked(Commander):
    """For several threads: each callback holds the lock."""

    def __init__(self):
        self.lock = threading.RLock()
        super().__init__()

    def on_distance(self, msg):
        with self.lock:
            super().on_distance(msg)

    def on_response(self, number, handle):
        with self.lock:
            super().on_response(number, handle)

    def on_stop(self, msg):
        with self.lock:
            super().on_stop(msg)

    def on_result(self, number, status):
        with self.lock:
            super().on_result(number, status)

    def watch(self):
        with self.lock:
            super().watch()


def main():
    """In several threads."""
    rclpy.init()
    executor = MultiThreadedExecutor(4)
    executor.add_node(Locked())
    with contextlib.suppress(KeyboardInterrupt):
        executor.spin()


class CanceledAtOnce(Commander):
    def on_stop(self, msg):
        super().on_stop(msg)
        if self.waiting:
            self.publish_state("canceled")


class BelievesTheCancelResponse(Commander):
    """A goal that is being canceled may still succeed."""

    def on_stop(self, msg):
        self.stop_requested = True
        if self.goal is not None:
            self.goal.cancel_goal_async().add_done_callback(self.on_cancel_response)

    def on_cancel_response(self, future):
        if future.result().goals_canceling:
            self.end("canceled")


class CanceledIfStopped(Commander):
    """Whatever ends after a stop was canceled."""

    def on_result(self, number, status):
        super().on_result(number, GoalStatus.STATUS_CANCELED if self.stop_requested else status)


class AlwaysSucceeded(Commander):
    def on_result(self, number, status):
        super().on_result(number, GoalStatus.STATUS_SUCCEEDED)


class SilenceForZeros(Commander):
    def __init__(self):
        super().__init__()
        self.commands = self.create_publisher(Twist, "/unused", 10)


class ZerosWithTheStop(Commander):
    """The server goes on until it has seen the request, and its next command moves the robot again."""

    def on_stop(self, msg):
        self.commands.publish(Twist())
        super().on_stop(msg)

    def on_result(self, number, status):
        if number == self.number:
            self.number += 1
            self.goal, self.waiting = None, False
            self.publish_state(STATES[status])


class NoZerosWhenLost(Commander):
    def watch(self):
        silence = (self.get_clock().now() - self.last_news).nanoseconds / 1e9
        if self.waiting and silence > self.patience:
            self.number += 1
            self.goal, self.waiting = None, False
            self.publish_state("lost")


class FirstResultOnly(Commander):
    """It takes one result, and ignores the second."""

    finished = False

    def on_result(self, number, status):
        if not self.finished:
            self.finished = True
            self.end(STATES[status])


class OlderResultsToo(Commander):
    """The result of an older goal ends the newer one."""

    def on_result(self, number, status):
        self.commands.publish(Twist())
        self.publish_state(STATES[status])
        self.waiting = False


class ForgetsAnEarlyStop(Commander):
    def on_response(self, number, handle):
        self.stop_requested = False
        super().on_response(number, handle)


class StopsTheOlder(Commander):
    """It cancels the goal whose handle it has, which is the older one."""

    def on_distance(self, msg):
        older = self.goal
        super().on_distance(msg)
        self.goal = older

    def on_stop(self, msg):
        if self.goal is not None:
            self.goal.cancel_goal_async()
        else:
            self.stop_requested = True


class NeverLost(Commander):
    def watch(self):
        pass


class AsksTheGraphOnly(Commander):
    """A server that is back at once seems never to have been away."""

    def watch(self):
        if self.waiting and not self.client.server_is_ready():
            self.end("lost")


class Impatient(Commander):
    patience = 0.15


class Patient(Commander):
    patience = 2.5


class StaysLost(Commander):
    lost = False

    def end(self, state):
        self.lost = self.lost or state == "lost"
        super().end(state)

    def on_distance(self, msg):
        if not self.lost:
            super().on_distance(msg)


class WaitsForTheOlder(Commander):
    """It sends the newer goal when the older one has ended."""

    queue = ()

    def on_distance(self, msg):
        if self.waiting:
            self.queue = (*self.queue, msg)
        else:
            super().on_distance(msg)

    def end(self, state):
        super().end(state)
        if self.queue:
            first, *self.queue = self.queue
            super().on_distance(first)


class NoState(Commander):
    def publish_state(self, state):
        self.get_logger().info(state)


class NeverDriving(Commander):
    def publish_state(self, state):
        if state != "driving":
            super().publish_state(state)


class TooFast(Commander):
    speed = 0.5
