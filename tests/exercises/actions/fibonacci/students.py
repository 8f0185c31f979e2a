"""First action servers: right ones, and wrong ones named by their defect."""

import time

import rclpy
from example_interfaces.action import Fibonacci
from nav2_msgs.action import Wait
from rclpy.action import ActionServer
from rclpy.node import Node


class FibonacciServer(Node):
    def __init__(self):
        super().__init__("fibonacci_server")
        self.server = ActionServer(self, Fibonacci, "/fibonacci", self.execute)

    def execute(self, goal_handle):
        sequence = [0, 1]
        while len(sequence) <= goal_handle.request.order:
            sequence.append(sequence[-1] + sequence[-2])
        return self.end(goal_handle, sequence)

    def end(self, goal_handle, sequence):
        goal_handle.succeed()
        return Fibonacci.Result(sequence=sequence)


class FibonacciActionServer(Node):
    """As tutorials list it: with feedback and a second of sleep for each number."""

    def __init__(self):
        super().__init__("fibonacci_action_server")
        self._action_server = ActionServer(self, Fibonacci, "fibonacci", self.execute_callback)

    def execute_callback(self, goal_handle):
        self.get_logger().info("Executing goal...")
        feedback_msg = Fibonacci.Feedback()
        feedback_msg.sequence = [0, 1]
        for i in range(1, goal_handle.request.order):
            feedback_msg.sequence.append(feedback_msg.sequence[i] + feedback_msg.sequence[i - 1])
            self.get_logger().info(f"Feedback: {feedback_msg.sequence}")
            goal_handle.publish_feedback(feedback_msg)
            time.sleep(1)
        goal_handle.succeed()
        result = Fibonacci.Result()
        result.sequence = feedback_msg.sequence
        return result


def tutorial_main(args=None):
    rclpy.init(args=args)
    fibonacci_action_server = FibonacciActionServer()
    rclpy.spin(fibonacci_action_server)


class AsyncServer(FibonacciServer):
    """A design of its own: execute is a coroutine."""

    async def execute(self, goal_handle):
        return super().execute(goal_handle)


def main_with_function():
    rclpy.init()
    node = Node("numbers")

    def execute(handle):
        result = Fibonacci.Result()
        a, b = 0, 1
        for _ in range(handle.request.order + 1):
            result.sequence.append(a)
            a, b = b, a + b
        handle.succeed()
        return result

    with ActionServer(node, Fibonacci, "fibonacci", execute):
        rclpy.spin(node)


class NoServer(FibonacciServer):
    def __init__(self):
        Node.__init__(self, "fibonacci_server")


class MisspeltName(FibonacciServer):
    def __init__(self):
        Node.__init__(self, "fibonacci_server")
        self.server = ActionServer(self, Fibonacci, "/fibonaci", self.execute)


class AnotherType(FibonacciServer):
    def __init__(self):
        Node.__init__(self, "fibonacci_server")
        self.server = ActionServer(self, Wait, "/fibonacci", self.execute)


class WithoutTheNode(FibonacciServer):
    def __init__(self):
        Node.__init__(self, "fibonacci_server")
        self.server = ActionServer(Fibonacci, "/fibonacci", self.execute)


class ForgetsToSucceed(FibonacciServer):
    def end(self, goal_handle, sequence):
        return Fibonacci.Result(sequence=sequence)


class Modest(FibonacciServer):
    """Lesson 4's: does the work, and doesn't say so."""

    def execute(self, goal_handle):
        return Fibonacci.Result(sequence=[0, 1, 1, 2, 3, 5, 8])


class ForgetsToReturn(FibonacciServer):
    def end(self, goal_handle, sequence):
        goal_handle.succeed()


class ReturnsTheList(FibonacciServer):
    def end(self, goal_handle, sequence):
        goal_handle.succeed()
        return sequence


class EmptyResult(FibonacciServer):
    def end(self, goal_handle, sequence):
        goal_handle.succeed()
        return Fibonacci.Result()


class OneTooFew(FibonacciServer):
    def end(self, goal_handle, sequence):
        return super().end(goal_handle, sequence[:-1])


class OneTooMany(FibonacciServer):
    def end(self, goal_handle, sequence):
        return super().end(goal_handle, [*sequence, sequence[-1] + sequence[-2]])


class Aborts(FibonacciServer):
    def end(self, goal_handle, sequence):
        goal_handle.abort()
        return Fibonacci.Result(sequence=sequence)


class CountsUp(FibonacciServer):
    def execute(self, goal_handle):
        return self.end(goal_handle, list(range(goal_handle.request.order + 1)))


class AsksTheHandleForTheOrder(FibonacciServer):
    def execute(self, goal_handle):
        return self.end(goal_handle, [0, 1][: goal_handle.order])


class SucceedsTwice(FibonacciServer):
    def end(self, goal_handle, sequence):
        goal_handle.succeed()
        return super().end(goal_handle, sequence)


class ObjectForType(Node):
    def __init__(self):
        super().__init__("fibonacci_server")
        self.server = ActionServer(self, Fibonacci(), "/fibonacci", print)


class ResultByPosition(FibonacciServer):
    def end(self, goal_handle, sequence):
        goal_handle.succeed()
        return Fibonacci.Result(sequence)
