"""Action servers and clients: feedback, success, cancel, reject, abort, async, forget to end."""

import time

import rclpy
from action_msgs.msg import GoalStatus
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node

STATUS = {value: name[7:] for name, value in vars(GoalStatus).items() if name.startswith("STATUS_")}


class Server(Node):
    """Gives one number each second."""

    def __init__(self, group=None):
        super().__init__("server")
        self.server = ActionServer(
            self, Fibonacci, "fibonacci", self.execute, callback_group=group,
            goal_callback=self.judge, cancel_callback=lambda goal: CancelResponse.ACCEPT,
        )  # fmt: skip

    def judge(self, goal):
        return GoalResponse.ACCEPT if goal.order < 10 else GoalResponse.REJECT

    def execute(self, goal):
        feedback = Fibonacci.Feedback(sequence=[0, 1])
        for _ in range(goal.request.order):
            if goal.is_cancel_requested:
                goal.canceled()
                return Fibonacci.Result(sequence=feedback.sequence)
            time.sleep(1.0)
            feedback.sequence.append(sum(feedback.sequence[-2:]))
            goal.publish_feedback(feedback)
        goal.succeed()
        return Fibonacci.Result(sequence=feedback.sequence)


class Aborting(Server):
    def execute(self, goal):
        time.sleep(1.0)
        goal.abort()
        return Fibonacci.Result()


class Forgetful(Server):
    """Returns without saying how it ended: rclpy aborts the goal."""

    def execute(self, goal):
        return Fibonacci.Result(sequence=[1])


class Raising(Server):
    def execute(self, goal):
        raise ValueError("no such number")


class Coroutine(Server):
    """An execute callback that is a coroutine."""

    async def execute(self, goal):
        goal.succeed()
        return Fibonacci.Result(sequence=[goal.request.order])


def parallel_server():
    """Can receive a cancel while it executes."""
    rclpy.init()
    executor = MultiThreadedExecutor()
    executor.add_node(Server(ReentrantCallbackGroup()))
    executor.spin()


class Client(Node):
    """Sends one goal and says all that comes back; cancels after a while if asked to."""

    order, cancel_after = 3, None

    def __init__(self):
        super().__init__("client")
        self.client = ActionClient(self, Fibonacci, "fibonacci")
        self.client.wait_for_server()
        goal = Fibonacci.Goal(order=self.order)
        self.client.send_goal_async(goal, feedback_callback=self.feedback).add_done_callback(self.answered)

    def say(self, text):
        self.get_logger().info(text)

    def feedback(self, message):
        self.say(f"feedback {list(message.feedback.sequence)}")

    def answered(self, future):
        self.goal = future.result()
        self.say(f"accepted {self.goal.accepted}")
        if self.goal.accepted:
            self.goal.get_result_async().add_done_callback(self.ended)
        if self.cancel_after:
            self.timer = self.create_timer(self.cancel_after, self.cancel)

    def cancel(self):
        self.timer.cancel()
        self.goal.cancel_goal_async().add_done_callback(
            lambda future: self.say(f"canceling {len(future.result().goals_canceling)}")
        )

    def ended(self, future):
        answer = future.result()
        self.say(f"{STATUS[answer.status]} {list(answer.result.sequence)}")


class Impatient(Client):
    cancel_after = 1.5


class Greedy(Client):
    order = 10


def waiting_client():
    """The same in one line after another, with spin_until_future_complete."""
    rclpy.init()
    node = Node("client")
    client = ActionClient(node, Fibonacci, "fibonacci")
    while not client.wait_for_server(timeout_sec=1.0):
        node.get_logger().info("waiting")
    future = client.send_goal_async(Fibonacci.Goal(order=2))
    rclpy.spin_until_future_complete(node, future)
    future = future.result().get_result_async()
    rclpy.spin_until_future_complete(node, future)
    node.get_logger().info(str(list(future.result().result.sequence)))


def blocking_client():
    """send_goal() waits in main() while a thread spins."""
    import threading

    rclpy.init()
    node = Node("client")
    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
    client = ActionClient(node, Fibonacci, "fibonacci")
    client.wait_for_server()
    answer = client.send_goal(Fibonacci.Goal(order=2))
    node.get_logger().info(f"{STATUS[answer.status]} {list(answer.result.sequence)}")


def late_server():
    time.sleep(1.5)
    rclpy.init()
    rclpy.spin(Server())
