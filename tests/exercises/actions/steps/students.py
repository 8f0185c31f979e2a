"""Servers that tell how they are doing, and refuse: right ones, and wrong ones named by their defect."""

import time

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer, GoalResponse
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future

PARTS = ("Pausing",)


class FibonacciReporter(Node):
    def __init__(self):
        super().__init__("fibonacci_server")
        self.server = ActionServer(self, Fibonacci, "/fibonacci", self.execute, goal_callback=self.judge)

    def judge(self, goal):
        return GoalResponse.ACCEPT if 1 <= goal.order <= 20 else GoalResponse.REJECT

    def execute(self, goal_handle):
        sequence = [0, 1]
        while len(sequence) <= goal_handle.request.order:
            sequence.append(sequence[-1] + sequence[-2])
            self.tell(goal_handle, sequence)
        goal_handle.succeed()
        return Fibonacci.Result(sequence=sequence)

    def tell(self, goal_handle, sequence):
        goal_handle.publish_feedback(Fibonacci.Feedback(sequence=sequence))
        time.sleep(0.5)


class Pausing(FibonacciReporter):
    async def pause(self, seconds):
        done = Future()
        timer = self.create_timer(seconds, lambda: done.set_result(None))
        await done
        self.destroy_timer(timer)


class AsyncReporter(Pausing):
    """A design of its own: execute is a coroutine."""

    async def execute(self, goal_handle):
        feedback = Fibonacci.Feedback(sequence=[0, 1])
        goal_handle.publish_feedback(feedback)
        for _ in range(goal_handle.request.order - 1):
            await self.pause(0.5)
            feedback.sequence.append(sum(feedback.sequence[-2:]))
            goal_handle.publish_feedback(feedback)
        goal_handle.succeed()
        return Fibonacci.Result(sequence=feedback.sequence)


def main_with_threads_and_rate():
    rclpy.init()
    node = Node("numbers")

    def execute(handle):
        rate, result = node.create_rate(2.0), Fibonacci.Result(sequence=[0, 1])
        while len(result.sequence) < handle.request.order + 1:
            rate.sleep()
            result.sequence.append(result.sequence[-1] + result.sequence[-2])
            handle.publish_feedback(Fibonacci.Feedback(sequence=result.sequence))
        handle.succeed()
        return result

    def judge(goal):
        if goal.order not in range(1, 21):
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    node.server = ActionServer(node, Fibonacci, "fibonacci", execute_callback=execute, goal_callback=judge)
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(node)
    executor.spin()


class TakesEverything(FibonacciReporter):
    def __init__(self):
        Node.__init__(self, "fibonacci_server")
        self.server = ActionServer(self, Fibonacci, "/fibonacci", self.execute)


class AnswersWithTrue(FibonacciReporter):
    def judge(self, goal):
        return 1 <= goal.order <= 20


class ForgetsToAccept(FibonacciReporter):
    def judge(self, goal):
        if not 1 <= goal.order <= 20:
            return GoalResponse.REJECT


class LimitsRefused(FibonacciReporter):
    def judge(self, goal):
        return GoalResponse.ACCEPT if 1 < goal.order < 20 else GoalResponse.REJECT


class NoUpperLimit(FibonacciReporter):
    def judge(self, goal):
        return GoalResponse.REJECT if goal.order < 1 else GoalResponse.ACCEPT


class TheWrongWayRound(FibonacciReporter):
    def judge(self, goal):
        return GoalResponse.REJECT if 1 <= goal.order <= 20 else GoalResponse.ACCEPT


class NoFeedback(FibonacciReporter):
    def tell(self, goal_handle, sequence):
        time.sleep(0.5)


class TellsTheNewestOnly(FibonacciReporter):
    def tell(self, goal_handle, sequence):
        super().tell(goal_handle, sequence[-1:])


class TellsAListInPlaceOfFeedback(FibonacciReporter):
    def tell(self, goal_handle, sequence):
        goal_handle.publish_feedback(sequence)


class NeverSleeps(FibonacciReporter):
    def tell(self, goal_handle, sequence):
        goal_handle.publish_feedback(Fibonacci.Feedback(sequence=sequence))


class SleepsTwiceAsLong(FibonacciReporter):
    def tell(self, goal_handle, sequence):
        super().tell(goal_handle, sequence)
        time.sleep(0.5)


class SleepsOnceAtTheEnd(FibonacciReporter):
    def execute(self, goal_handle):
        sequence = [0, 1]
        while len(sequence) <= goal_handle.request.order:
            sequence.append(sequence[-1] + sequence[-2])
        self.tell(goal_handle, sequence)
        goal_handle.succeed()
        return Fibonacci.Result(sequence=sequence)


class AbortsInPlaceOfRejecting(FibonacciReporter):
    def judge(self, goal):
        return GoalResponse.ACCEPT

    def execute(self, goal_handle):
        if not 1 <= goal_handle.request.order <= 20:
            goal_handle.abort()
            return Fibonacci.Result()
        return super().execute(goal_handle)


class SucceedsInTheLoop(FibonacciReporter):
    def tell(self, goal_handle, sequence):
        super().tell(goal_handle, sequence)
        goal_handle.succeed()


class LosesTheFirstNumber(FibonacciReporter):
    def execute(self, goal_handle):
        result = super().execute(goal_handle)
        return Fibonacci.Result(sequence=result.sequence[1:])


class MisspeltName(FibonacciReporter):
    def __init__(self):
        Node.__init__(self, "fibonacci_server")
        self.server = ActionServer(self, Fibonacci, "/fibonaccy", self.execute, goal_callback=self.judge)


class FeedbackByKeyword(FibonacciReporter):
    def tell(self, goal_handle, sequence):
        goal_handle.publish_feedback(sequence=sequence)
