"""Action servers and clients that do something unusual, each named by it."""

import time

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from unique_identifier_msgs.msg import UUID

from tests.students.engine.actions import Client, Impatient, Server


class AlwaysRejectsCancel(Server):
    """Leaves out the cancel callback: rclpy's own refuses."""

    def __init__(self, group=None):
        Node.__init__(self, "server")
        self.server = ActionServer(self, Fibonacci, "fibonacci", self.execute, callback_group=group)


class IgnoresCancel(Server):
    """Accepts to cancel, and goes on."""

    def execute(self, goal):
        time.sleep(3.0)
        goal.succeed()
        return Fibonacci.Result(sequence=[1])


def parallel(server_class):
    """A program whose server can receive a cancel while it executes."""

    def main():
        rclpy.init()
        executor = MultiThreadedExecutor()
        executor.add_node(server_class(ReentrantCallbackGroup()))
        executor.spin()

    return main


class SucceedsTwice(Server):
    def execute(self, goal):
        goal.succeed()
        goal.succeed()


class ReturnsNothing(Server):
    def execute(self, goal):
        goal.succeed()


class FeedbackOfAnotherType(Server):
    def execute(self, goal):
        goal.publish_feedback([0, 1])


class JudgesWithTrue(Server):
    """Returns True where a GoalResponse is asked for: rclpy rejects the goal."""

    def judge(self, goal):
        return True


class JudgeRaises(Server):
    def judge(self, goal):
        raise ValueError("no judgment")


class Later(Server):
    """Accepts at once and executes two seconds later."""

    def __init__(self):
        Node.__init__(self, "server")
        self.server = ActionServer(
            self, Fibonacci, "fibonacci", self.execute, handle_accepted_callback=self.accept,
            cancel_callback=lambda goal: CancelResponse.ACCEPT,
        )  # fmt: skip

    def accept(self, goal):
        self.timer = self.create_timer(2.0, lambda: (self.timer.cancel(), goal.execute()))


class CancelsTwice(Impatient):
    def cancel(self):
        self.goal.cancel_goal_async()
        super().cancel()


class AsksAtOnce(Client):
    """Sends a goal the moment its client is made, and again a second later."""

    def __init__(self):
        Node.__init__(self, "client")
        self.client = ActionClient(self, Fibonacci, "fibonacci")
        self.ask()
        self.timer = self.create_timer(1.0, self.ask)

    def ask(self):
        self.client.send_goal_async(Fibonacci.Goal(order=1)).add_done_callback(self.answered)


class SameIdTwice(Client):
    """Sends a second goal with the id of the first while that is executed."""

    def __init__(self):
        Node.__init__(self, "client")
        self.client = ActionClient(self, Fibonacci, "fibonacci")
        self.client.wait_for_server()
        for order in (1, 2):
            goal = Fibonacci.Goal(order=order)
            future = self.client.send_goal_async(goal, goal_uuid=UUID(uuid=list(range(16))))
            future.add_done_callback(self.answered)


class AsksForNoResult(Client):
    def answered(self, future):
        pass


def never_spins():
    rclpy.init()
    node = Node("client")
    client = ActionClient(node, Fibonacci, "fibonacci")
    client.wait_for_server()
    future = client.send_goal_async(Fibonacci.Goal(order=1))
    while not future.done():
        time.sleep(0.1)


def two_servers():
    """Both in one program, so that their order is known."""
    rclpy.init()
    executor = SingleThreadedExecutor()
    for name in ("one", "two"):
        node = Node(name)
        node.server = ActionServer(node, Fibonacci, "fibonacci", _at_once)
        executor.add_node(node)
    executor.spin()


def _at_once(goal):
    goal.succeed()
    return Fibonacci.Result(sequence=[goal.request.order])


def sends_text():
    rclpy.init()
    node = Node("client")
    client = ActionClient(node, Fibonacci, "fibonacci")
    try:
        client.send_goal_async("3")
    except TypeError as error:
        node.get_logger().info(str(error))
    client.send_goal("3")


def asks_past_the_client():
    """Sends a goal with the insides of rclpy's action client."""
    rclpy.init()
    node = Node("client")
    client = ActionClient(node, Fibonacci, "fibonacci")
    request = Fibonacci.Impl.SendGoalService.Request(goal=Fibonacci.Goal(order=1))
    client._client_handle.send_goal_request(request)
    rclpy.spin(node)


def asks_no_one():
    rclpy.init()
    node = Node("client")
    ActionClient(node, Fibonacci, "fibonacci").send_goal_async(Fibonacci.Goal(order=1))
    rclpy.spin(node)


class Busy(Server):
    """Needs longer than any run of a test."""

    def execute(self, goal):
        time.sleep(100.0)


class AbortsOnCancel(Server):
    def execute(self, goal):
        time.sleep(2.0)
        goal.abort()
        return Fibonacci.Result()


class OwnServer(ActionServer):
    """A class of the student's own."""


class OwnClient(ActionClient):
    """A class of the student's own."""


class ServerOfAnOwnClass(Server):
    def __init__(self):
        Node.__init__(self, "server")
        self.server = OwnServer(self, Fibonacci, "fibonacci", self.execute)


class ClientOfAnOwnClass(Client):
    def __init__(self):
        Node.__init__(self, "client")
        self.client = OwnClient(self, Fibonacci, "fibonacci")
        self.client.wait_for_server()
        self.client.send_goal_async(Fibonacci.Goal(order=1)).add_done_callback(self.answered)


class DestroysItsServer(Server):
    """Is destroyed while it executes a goal."""

    def execute(self, goal):
        self.server.destroy()
        goal.publish_feedback(Fibonacci.Feedback(sequence=[1]))
        goal.succeed()
        return Fibonacci.Result(sequence=[1])


class DestroysItsServerAsItJudges(Server):
    """Is gone before it can answer whether it accepts a goal."""

    def __init__(self):
        Node.__init__(self, "server")
        self.server = ActionServer(self, Fibonacci, "fibonacci", self.execute, goal_callback=self.judge)

    def judge(self, request):
        self.server.destroy()
        return GoalResponse.ACCEPT


class DestroysItsServerAsItCancels(Server):
    """Is gone before it can answer whether a goal is canceled."""

    def __init__(self):
        Node.__init__(self, "server")
        group = ReentrantCallbackGroup()
        self.server = ActionServer(
            self, Fibonacci, "fibonacci", self.execute, cancel_callback=self.cancel, callback_group=group
        )

    async def execute(self, goal):
        await rclpy.task.Future()

    def cancel(self, goal):
        self.server.destroy()
        return CancelResponse.ACCEPT


def sends_again():
    """Sends a goal to no one, and after two seconds one with the same id to someone."""
    rclpy.init()
    node = Node("client")
    client = ActionClient(node, Fibonacci, "fibonacci")
    for order in (1, 2):
        client.send_goal_async(Fibonacci.Goal(order=order), goal_uuid=UUID(uuid=list(range(16))))
        time.sleep(2.0)
    rclpy.spin(node)
