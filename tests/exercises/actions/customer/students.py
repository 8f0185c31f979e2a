"""Clients of /fibonacci: right ones, and wrong ones named by their defect."""

import rclpy
from example_interfaces.action import Fibonacci
from nav2_msgs.action import Wait
from rclpy.action import ActionClient
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node

PARTS = ("FibonacciActionClient",)


class Customer(Node):
    order, action = 7, "/fibonacci"

    def __init__(self):
        super().__init__("customer")
        self.client = ActionClient(self, Fibonacci, self.action)
        self.timer = self.create_timer(0.1, self.ask)

    def ask(self):
        if self.client.server_is_ready():
            self.timer.cancel()
            self.send()

    def send(self):
        goal = Fibonacci.Goal(order=self.order)
        future = self.client.send_goal_async(goal, feedback_callback=self.on_feedback)
        future.add_done_callback(self.on_response)

    def on_feedback(self, msg):
        self.get_logger().info(f"progress: {msg.feedback.sequence[-1]}")

    def on_response(self, future):
        goal_handle = future.result()
        if not goal_handle.accepted:
            self.get_logger().warning("The goal was rejected.")
            return
        goal_handle.get_result_async().add_done_callback(self.on_result)

    def on_result(self, future):
        self.get_logger().info(f"result: {list(future.result().result.sequence)}")


class FibonacciActionClient(Node):
    """As tutorials list it, with a warning in place of an info line."""

    def __init__(self):
        super().__init__("fibonacci_action_client")
        self._action_client = ActionClient(self, Fibonacci, "fibonacci")

    def send_goal(self, order):
        goal_msg = Fibonacci.Goal()
        goal_msg.order = order
        self._action_client.wait_for_server()
        self._send_goal_future = self._action_client.send_goal_async(
            goal_msg, feedback_callback=self.feedback_callback
        )
        self._send_goal_future.add_done_callback(self.goal_response_callback)

    def goal_response_callback(self, future):
        goal_handle = future.result()
        if not goal_handle.accepted:
            self.get_logger().warn("Goal rejected :(")
            return
        self.get_logger().info("Goal accepted :)")
        self._get_result_future = goal_handle.get_result_async()
        self._get_result_future.add_done_callback(self.get_result_callback)

    def get_result_callback(self, future):
        result = future.result().result
        self.get_logger().info(f"Result: {result.sequence}")
        rclpy.shutdown()

    def feedback_callback(self, feedback_msg):
        feedback = feedback_msg.feedback
        self.get_logger().info(f"Received feedback: {feedback.sequence}")


def tutorial_main(args=None):
    rclpy.init(args=args)
    action_client = FibonacciActionClient()
    action_client.send_goal(7)
    rclpy.spin(action_client)


class AwaitingCustomer(Node):
    """A design of its own: one coroutine from the goal to the result."""

    def __init__(self):
        super().__init__("customer")
        group = ReentrantCallbackGroup()
        self.client = ActionClient(self, Fibonacci, "fibonacci", callback_group=group)
        self.timer = self.create_timer(0.2, self.ask, callback_group=group)

    async def ask(self):
        if not self.client.server_is_ready():
            return
        self.timer.cancel()
        handle = await self.client.send_goal_async(Fibonacci.Goal(order=7), self.on_feedback)
        if handle.accepted:
            answer = await handle.get_result_async()
            self.get_logger().info("The result is " + ", ".join(map(str, answer.result.sequence)))
        else:
            self.get_logger().warning("rejected")

    def on_feedback(self, msg):
        self.get_logger().info(str(list(msg.feedback.sequence)))


def main_that_waits_for_futures():
    rclpy.init()
    node = Node("customer")
    client = ActionClient(node, Fibonacci, "fibonacci")
    client.wait_for_server()
    future = client.send_goal_async(
        Fibonacci.Goal(order=7),
        feedback_callback=lambda msg: node.get_logger().info(f"{msg.feedback.sequence[-1]}"),
    )
    rclpy.spin_until_future_complete(node, future)
    if not future.result().accepted:
        node.get_logger().warning("The goal was rejected")
        return
    result = future.result().get_result_async()
    rclpy.spin_until_future_complete(node, result)
    node.get_logger().info(f"result {result.result().result.sequence.tolist()}")


class SendsNothing(Customer):
    def send(self):
        pass


class AsksTooEarly(Customer):
    def ask(self):
        self.timer.cancel()
        self.send()


class AnotherOrder(Customer):
    order = 5


class MisspeltName(Customer):
    action = "/fibonaci"


class AnotherType(Customer):
    def __init__(self):
        Node.__init__(self, "customer")
        self.client = ActionClient(self, Wait, "/fibonacci")
        self.timer = self.create_timer(0.1, self.ask)


class SendsANumber(Customer):
    def send(self):
        self.client.send_goal_async(7)


class WithoutFeedback(Customer):
    def send(self):
        future = self.client.send_goal_async(Fibonacci.Goal(order=self.order))
        future.add_done_callback(self.on_response)


class FeedbackWithoutFeedback(Customer):
    """The message has the feedback inside."""

    def on_feedback(self, msg):
        self.get_logger().info(f"progress: {msg.sequence[-1]}")


class LogsTheFirstNumber(Customer):
    def on_feedback(self, msg):
        self.get_logger().info(f"progress: {msg.feedback.sequence[0]}")


class NoOneReceivesTheResponse(Customer):
    def send(self):
        self.client.send_goal_async(Fibonacci.Goal(order=7), feedback_callback=self.on_feedback)


class NeverAsksForTheResult(Customer):
    def on_response(self, future):
        if not future.result().accepted:
            self.get_logger().warning("The goal was rejected.")


class ReadsTheResultOfTheResponse(Customer):
    def on_response(self, future):
        if not future.result().accepted:
            self.get_logger().warning("The goal was rejected.")
            return
        self.on_result(future)


class LogsTheWholeAnswer(Customer):
    """Result inside result."""

    def on_result(self, future):
        self.get_logger().info(f"result: {list(future.result().sequence)}")


class NeverLooksAtAccepted(Customer):
    def on_response(self, future):
        future.result().get_result_async().add_done_callback(self.on_result)


class AlwaysSaysRejected(Customer):
    def on_response(self, future):
        self.get_logger().warning("The goal was rejected.")
        if future.result().accepted:
            future.result().get_result_async().add_done_callback(self.on_result)


class BracketsTooMany(Customer):
    def send(self):
        future = self.client.send_goal_async(Fibonacci.Goal(order=7), feedback_callback=self.on_feedback)
        future.add_done_callback(self.on_response(future))


class WaitsInTheCallback(Customer):
    def send(self):
        future = self.client.send_goal_async(Fibonacci.Goal(order=7), feedback_callback=self.on_feedback)
        rclpy.spin_until_future_complete(self, future)
        self.on_response(future)


class LogsTheLastNumberOnly(Customer):
    def on_result(self, future):
        self.get_logger().info(f"result: {future.result().result.sequence[-1]}")


def main_that_logs_that_it_waits():
    """Right, too: it waits for the server with a time limit, and logs that it does."""
    rclpy.init()
    node = Customer()
    node.timer.cancel()
    while not node.client.wait_for_server(timeout_sec=1.0):
        node.get_logger().info("Waiting for /fibonacci")
    node.send()
    rclpy.spin(node)


class LogsManyNumbers(Customer):
    """Each line has all numbers, among them the right one."""

    numbers = " ".join(map(str, range(50)))

    def on_feedback(self, msg):
        self.get_logger().info(f"progress: {self.numbers}")

    def on_result(self, future):
        self.get_logger().info(f"result: 0 1 1 2 3 5 8 13 {self.numbers}")
