"""The goal of lesson 4a: a robot that draws Fibonacci numbers, and a client that orders them."""

import math

from example_interfaces.action import Fibonacci
from geometry_msgs.msg import Twist
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.task import Future


class SpiralServer(Node):
    """Serves /fibonacci: draws each number as a quarter circle with that radius, which makes a spiral."""

    unit = 0.05  # m, the radius for the number 1
    turn = math.pi / 6  # rad/s: a quarter circle takes 3 s

    def __init__(self):
        super().__init__("spiral_server")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.server = ActionServer(
            self,
            Fibonacci,
            "/fibonacci",
            self.execute,
            goal_callback=self.on_goal,
            cancel_callback=self.on_cancel,
        )

    def on_goal(self, goal):
        """Accept only what the robot has room for."""
        return GoalResponse.ACCEPT if 1 <= goal.order <= 8 else GoalResponse.REJECT

    def on_cancel(self, goal_handle):
        """Accept every cancel request."""
        return CancelResponse.ACCEPT

    async def execute(self, goal_handle):
        """Draw one number after the other."""
        sequence = [0, 1]
        while len(sequence) <= goal_handle.request.order:
            sequence.append(sequence[-1] + sequence[-2])
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=sequence))
            for _ in range(30):
                if goal_handle.is_cancel_requested:
                    self.send()  # stop the robot first, then report it
                    goal_handle.canceled()
                    return Fibonacci.Result(sequence=sequence)
                self.send(speed=self.turn * self.unit * sequence[-1], turn=self.turn)
                await self.pause(0.1)
        self.send()
        goal_handle.succeed()
        return Fibonacci.Result(sequence=sequence)

    def send(self, speed=0.0, turn=0.0):
        """Command a speed, in m/s, and a turn, in rad/s; without arguments: stop."""
        msg = Twist()
        msg.linear.x, msg.angular.z = speed, turn
        self.publisher.publish(msg)

    async def pause(self, seconds):
        """Wait, and let other callbacks run meanwhile."""
        done = Future()
        group = ReentrantCallbackGroup()
        timer = self.create_timer(seconds, lambda: done.set_result(None), callback_group=group)
        await done
        self.destroy_timer(timer)


class Client(Node):
    """Orders the first eight numbers, and logs how far the server has got."""

    def __init__(self):
        super().__init__("client")
        self.client = ActionClient(self, Fibonacci, "/fibonacci")
        self.timer = self.create_timer(1.0, self.send)

    def send(self):
        """Send the goal as soon as there is a server."""
        if self.client.server_is_ready():
            self.timer.cancel()
            self.client.send_goal_async(Fibonacci.Goal(order=8), feedback_callback=self.on_feedback)

    def on_feedback(self, msg):
        """Log the newest number."""
        self.get_logger().info(f"now drawing {msg.feedback.sequence[-1]}")
