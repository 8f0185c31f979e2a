"""A cancel that comes before the goal's handle is lost, and the goal goes on (as in rosbridge#1013)."""

import time

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty


class Bridge(Node):
    """Sends a goal on /go, and cancels it on /stop."""

    def __init__(self):
        super().__init__("bridge")
        self.client = ActionClient(self, Fibonacci, "fibonacci")
        self.goal = None
        self.create_subscription(Empty, "go", self.on_go, 10)
        self.create_subscription(Empty, "stop", self.on_stop, 10)

    def on_go(self, message):
        future = self.client.send_goal_async(Fibonacci.Goal(order=5))
        future.add_done_callback(self.on_answer)

    def on_answer(self, future):
        self.goal = future.result()

    def on_stop(self, message):
        if self.goal is not None:
            self.goal.cancel_goal_async()


class RemembersStop(Bridge):
    """Remembers a stop that comes too early, and ignores a goal that comes after one."""

    stopped = False

    def on_go(self, message):
        if not self.stopped:
            super().on_go(message)

    def on_answer(self, future):
        super().on_answer(future)
        if self.stopped:
            self.goal.cancel_goal_async()

    def on_stop(self, message):
        self.stopped = True
        super().on_stop(message)


class Operator(Node):
    """Says go after a second, and stop 3 ms later."""

    def __init__(self):
        super().__init__("operator")
        for topic, delay in (("go", 1.0), ("stop", 1.003)):
            self.send_once(self.create_publisher(Empty, topic, 10), delay)

    def send_once(self, publisher, delay):
        def send():
            publisher.publish(Empty())
            timer.cancel()

        timer = self.create_timer(delay, send)


def server():
    """A server whose goals take half a second."""

    def execute(goal):
        for _ in range(10):
            time.sleep(0.05)
            if goal.is_cancel_requested:
                goal.canceled()
                return Fibonacci.Result()
        goal.succeed()
        return Fibonacci.Result()

    rclpy.init()
    node = Node("server")
    ActionServer(
        node,
        Fibonacci,
        "fibonacci",
        execute,
        callback_group=ReentrantCallbackGroup(),
        cancel_callback=lambda goal: CancelResponse.ACCEPT,
    )
    executor = MultiThreadedExecutor(4)
    executor.add_node(node)
    executor.spin()


def holds(run):
    """No goal runs on after the stop."""
    return not run.errors and all(goal.status != "succeeded" for goal in run.goals)


WRONG, RIGHT = (Bridge, Operator, server), (RemembersStop, Operator, server)
