"""Servers that can be stopped: right ones, and wrong ones named by their defect."""

import asyncio
import time

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future

PARTS = ("MinimalActionServer", "StoppableServer", "threaded")


class StoppableServer(Node):
    def __init__(self):
        super().__init__("fibonacci_server")
        self.server = self.offer()

    def offer(self):
        return ActionServer(self, Fibonacci, "/fibonacci", self.execute, cancel_callback=self.on_cancel)

    def on_cancel(self, goal_handle):
        return CancelResponse.ACCEPT

    def execute(self, goal_handle):
        sequence = [0, 1]
        while len(sequence) <= goal_handle.request.order:
            if goal_handle.is_cancel_requested:
                return self.stop(goal_handle, sequence)
            sequence.append(sequence[-1] + sequence[-2])
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=sequence))
            time.sleep(0.5)
        goal_handle.succeed()
        return Fibonacci.Result(sequence=sequence)

    def stop(self, goal_handle, sequence):
        goal_handle.canceled()
        return Fibonacci.Result(sequence=sequence)


def threaded(node_class, threads=2):
    rclpy.init()
    node = node_class()
    executor = MultiThreadedExecutor(num_threads=threads)
    executor.add_node(node)
    executor.spin()


def main():
    threaded(StoppableServer)


class MinimalActionServer(Node):
    """As examples list it: with all callbacks, and a reentrant group."""

    def __init__(self):
        super().__init__("minimal_action_server")
        self._action_server = ActionServer(
            self,
            Fibonacci,
            "fibonacci",
            execute_callback=self.execute_callback,
            callback_group=ReentrantCallbackGroup(),
            goal_callback=self.goal_callback,
            cancel_callback=self.cancel_callback,
        )

    def destroy(self):
        self._action_server.destroy()
        super().destroy_node()

    def goal_callback(self, goal_request):
        self.get_logger().info("Received goal request")
        return GoalResponse.ACCEPT

    def cancel_callback(self, goal_handle):
        self.get_logger().info("Received cancel request")
        return CancelResponse.ACCEPT

    async def execute_callback(self, goal_handle):
        feedback_msg = Fibonacci.Feedback()
        feedback_msg.sequence = [0, 1]
        for i in range(1, goal_handle.request.order):
            if goal_handle.is_cancel_requested:
                goal_handle.canceled()
                self.get_logger().info("Goal canceled")
                result = Fibonacci.Result()
                result.sequence = feedback_msg.sequence
                return result
            feedback_msg.sequence.append(feedback_msg.sequence[i] + feedback_msg.sequence[i - 1])
            goal_handle.publish_feedback(feedback_msg)
            time.sleep(1)
        goal_handle.succeed()
        result = Fibonacci.Result()
        result.sequence = feedback_msg.sequence
        return result


def main_of_the_example(args=None):
    rclpy.init(args=args)
    minimal_action_server = MinimalActionServer()
    executor = MultiThreadedExecutor()
    rclpy.spin(minimal_action_server, executor=executor)
    minimal_action_server.destroy()
    rclpy.shutdown()


class AsyncStoppable(StoppableServer):
    """No threads: pauses in place of sleeping."""

    async def pause(self, seconds):
        done = Future()
        timer = self.create_timer(seconds, lambda: done.set_result(None))
        await done
        self.destroy_timer(timer)

    async def execute(self, goal_handle):
        sequence = [0, 1]
        while len(sequence) <= goal_handle.request.order:
            await self.pause(0.5)
            if goal_handle.is_cancel_requested:
                return self.stop(goal_handle, sequence)
            sequence.append(sequence[-1] + sequence[-2])
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=sequence))
        goal_handle.succeed()
        return Fibonacci.Result(sequence=sequence)


class ByATimer(StoppableServer):
    """A design of its own: a timer does the work, and execute only waits for its end."""

    def __init__(self):
        super().__init__()
        self.goal, self.sequence, self.done = None, [], Future()
        self.create_timer(0.5, self.tick)

    async def execute(self, goal_handle):
        self.goal, self.sequence, self.done = goal_handle, [0, 1], Future()
        return await self.done

    def tick(self):
        if self.goal is None:
            return
        if self.goal.is_cancel_requested:
            self.end(self.goal.canceled)
        elif len(self.sequence) > self.goal.request.order:
            self.end(self.goal.succeed)
        else:
            self.sequence.append(sum(self.sequence[-2:]))
            self.goal.publish_feedback(Fibonacci.Feedback(sequence=self.sequence))

    def end(self, how):
        how()
        self.goal = None
        self.done.set_result(Fibonacci.Result(sequence=self.sequence))


class OneThread(StoppableServer):
    """The trap of this exercise: no one can receive while it sleeps."""


def main_that_spins_with_one_thread():
    rclpy.init()
    rclpy.spin(StoppableServer())


class ReentrantAlone(StoppableServer):
    """A group alone doesn't help a node that has one thread."""

    def offer(self):
        group = ReentrantCallbackGroup()
        return ActionServer(
            self,
            Fibonacci,
            "/fibonacci",
            self.execute,
            cancel_callback=self.on_cancel,
            callback_group=group,
        )


def main_without_cancel_callback():
    class Refusing(StoppableServer):
        def offer(self):
            return ActionServer(self, Fibonacci, "/fibonacci", self.execute)

    threaded(Refusing)


def main_that_refuses():
    class Refusing(StoppableServer):
        def on_cancel(self, goal_handle):
            return CancelResponse.REJECT

    threaded(Refusing)


def main_that_answers_nothing():
    class Silent(StoppableServer):
        def on_cancel(self, goal_handle):
            self.get_logger().info("I heard it")

    threaded(Silent)


def main_that_never_looks():
    class Stubborn(StoppableServer):
        def execute(self, goal_handle):
            sequence = [0, 1]
            while len(sequence) <= goal_handle.request.order:
                sequence.append(sequence[-1] + sequence[-2])
                goal_handle.publish_feedback(Fibonacci.Feedback(sequence=sequence))
                time.sleep(0.5)
            goal_handle.succeed()
            return Fibonacci.Result(sequence=sequence)

    threaded(Stubborn)


def main_that_aborts():
    class Aborting(StoppableServer):
        def stop(self, goal_handle, sequence):
            goal_handle.abort()
            return Fibonacci.Result(sequence=sequence)

    threaded(Aborting)


def main_that_succeeds_all_the_same():
    class Boasting(StoppableServer):
        def stop(self, goal_handle, sequence):
            goal_handle.succeed()
            return Fibonacci.Result(sequence=sequence)

    threaded(Boasting)


def main_that_forgets_to_succeed():
    class Modest(StoppableServer):
        def execute(self, goal_handle):
            sequence = [0, 1]
            while len(sequence) <= goal_handle.request.order:
                if goal_handle.is_cancel_requested:
                    return self.stop(goal_handle, sequence)
                sequence.append(sequence[-1] + sequence[-2])
                goal_handle.publish_feedback(Fibonacci.Feedback(sequence=sequence))
                time.sleep(0.5)
            return Fibonacci.Result(sequence=sequence)

    threaded(Modest)


def main_with_an_empty_result():
    class Forgetful(StoppableServer):
        def stop(self, goal_handle, sequence):
            goal_handle.canceled()
            return Fibonacci.Result()

    threaded(Forgetful)


def main_without_return():
    class GoesOn(StoppableServer):
        def stop(self, goal_handle, sequence):
            goal_handle.canceled()

    threaded(GoesOn)


class SleepingServer(StoppableServer):
    """Lesson 4's: with one thread, no cancel request is received while it sleeps."""

    def execute(self, goal_handle):
        sequence = [0, 1]
        while len(sequence) <= goal_handle.request.order:
            if goal_handle.is_cancel_requested:
                goal_handle.canceled()
                return Fibonacci.Result(sequence=sequence)
            sequence.append(sequence[-1] + sequence[-2])
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=sequence))
            time.sleep(0.5)
        goal_handle.succeed()
        return Fibonacci.Result(sequence=sequence)


def main_that_breaks_out_of_the_loop():
    class Breaks(StoppableServer):
        def execute(self, goal_handle):
            sequence = [0, 1]
            while len(sequence) <= goal_handle.request.order:
                if goal_handle.is_cancel_requested:
                    goal_handle.canceled()
                    break
                sequence.append(sequence[-1] + sequence[-2])
                goal_handle.publish_feedback(Fibonacci.Feedback(sequence=sequence))
                time.sleep(0.5)
            goal_handle.succeed()
            return Fibonacci.Result(sequence=sequence)

    threaded(Breaks)


def main_with_brackets():
    class Calls(StoppableServer):
        def execute(self, goal_handle):
            sequence = [0, 1]
            if goal_handle.is_cancel_requested():
                return self.stop(goal_handle, sequence)
            return super().execute(goal_handle)

    threaded(Calls)


def main_that_cancels_everything():
    class Cancels(StoppableServer):
        def execute(self, goal_handle):
            time.sleep(0.5)
            goal_handle.canceled()
            return Fibonacci.Result()

    threaded(Cancels)


def main_that_looks_too_rarely():
    class Rarely(StoppableServer):
        def execute(self, goal_handle):
            time.sleep(6.0)
            return super().execute(goal_handle)

    threaded(Rarely)


def main_with_a_group_for_one():
    """Right, too: execute runs outside of every group."""

    class Exclusive(StoppableServer):
        def offer(self):
            group = MutuallyExclusiveCallbackGroup()
            return ActionServer(
                self,
                Fibonacci,
                "/fibonacci",
                self.execute,
                cancel_callback=self.on_cancel,
                callback_group=group,
            )

    threaded(Exclusive)


def main_without_spin():
    rclpy.init()
    executor = MultiThreadedExecutor()
    executor.add_node(StoppableServer())


def main_that_never_adds_the_node():
    rclpy.init()
    node = StoppableServer()
    executor = MultiThreadedExecutor()
    executor.spin()
    node.destroy_node()


class MisspeltName(StoppableServer):
    def offer(self):
        return ActionServer(self, Fibonacci, "/fibonaccy", self.execute, cancel_callback=self.on_cancel)


class NeverSleeps(StoppableServer):
    """It is over before anybody can cancel it."""

    def execute(self, goal_handle):
        sequence = [0, 1]
        while len(sequence) <= goal_handle.request.order:
            sequence.append(sequence[-1] + sequence[-2])
        goal_handle.succeed()
        return Fibonacci.Result(sequence=sequence)


class AwaitsAsyncio(AsyncStoppable):
    """The executor of rclpy runs the coroutine, and asyncio has no event loop there."""

    async def pause(self, seconds):
        await asyncio.sleep(seconds)


class PausesInAGroupOfItsOwn(AsyncStoppable):
    """Right, too: such a pause works in a timer's callback as well."""

    async def pause(self, seconds):
        done, group = Future(), ReentrantCallbackGroup()
        timer = self.create_timer(seconds, lambda: done.set_result(None), callback_group=group)
        await done
        self.destroy_timer(timer)
