"""Action servers for students' clients; they drive by the clock alone, less exactly than by odometry."""

import random
from collections.abc import Callable
from typing import Any

from example_interfaces.action import Fibonacci
from geometry_msgs.msg import Twist
from nav2_msgs.action import DriveOnHeading, Spin
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.node import Node
from rclpy.task import Future

TICK = 0.1  # seconds between two commands


class PausableNode(Node):
    """A node whose async callbacks can pause."""

    async def pause(self, seconds: float) -> None:
        """Let other callbacks run for some seconds."""
        done = Future()
        timer = self.create_timer(seconds, lambda: done.set_result(None))
        await done
        self.destroy_timer(timer)


class LateFibonacci(PausableNode):
    """Offers /fibonacci, but only after a while. When and how fast comes from the seed of the run."""

    answer = GoalResponse.ACCEPT

    def __init__(self) -> None:
        super().__init__("late_fibonacci")
        self.seconds = random.uniform(0.3, 0.6)  # for each number
        self.timer = self.create_timer(random.uniform(0.8, 1.6), self.open)

    def open(self) -> None:
        """Offer the action."""
        self.timer.cancel()
        try:
            self.server = ActionServer(self, Fibonacci, "/fibonacci", self.execute,
                                       goal_callback=lambda goal: self.answer)
        except ValueError:
            self.get_logger().error("Another node uses /fibonacci with another type.")

    async def execute(self, handle: ServerGoalHandle) -> Fibonacci.Result:
        """Publish the sequence number by number."""
        numbers = [0, 1]
        while len(numbers) <= handle.request.order:
            await self.pause(self.seconds)
            numbers.append(numbers[-1] + numbers[-2])
            handle.publish_feedback(Fibonacci.Feedback(sequence=numbers))
        handle.succeed()
        return Fibonacci.Result(sequence=numbers)


class BusyFibonacci(LateFibonacci):
    """Offers /fibonacci, and rejects every goal."""

    answer = GoalResponse.REJECT


class TimedMover(PausableNode):
    """Publishes one velocity for some time."""

    def __init__(self, name: str, action: type, topic: str) -> None:
        super().__init__(name)
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.server = ActionServer(self, action, topic, self.execute,
                                   cancel_callback=lambda handle: CancelResponse.ACCEPT)

    async def move(
        self, handle: ServerGoalHandle, velocity: Twist, seconds: float, report: Callable[[float], str]
    ) -> str:
        """Bring a goal to its end. report: publishes feedback after some seconds, and returns it as text."""
        for tick in range(round(seconds / TICK)):
            if handle.is_cancel_requested:
                self.publisher.publish(Twist())
                handle.canceled()
                return f"stopped after {report(tick * TICK)}"
            self.publisher.publish(velocity)
            report(tick * TICK)
            await self.pause(TICK)
        self.publisher.publish(Twist())
        await self.pause(0.5)  # until the robot stands
        report(seconds)
        handle.succeed()
        return ""

    async def execute(self, handle: ServerGoalHandle) -> Any:
        """Bring a goal to its end."""
        raise NotImplementedError


class DriveServer(TimedMover):
    """Offers /drive_on_heading: drives target.x meters ahead at a speed."""

    slower = 1.0

    def __init__(self) -> None:
        super().__init__("drive_server", DriveOnHeading, "/drive_on_heading")

    async def execute(self, handle: ServerGoalHandle) -> DriveOnHeading.Result:
        """Bring a goal to its end."""
        goal, velocity = handle.request, Twist()
        if not goal.speed > 0 or not goal.target.x > 0:
            handle.abort()
            code = DriveOnHeading.Result.INVALID_INPUT
            return DriveOnHeading.Result(error_code=code, error_msg="target.x and speed have to be above 0")
        velocity.linear.x = min(goal.speed, 0.6) / self.slower

        def report(seconds: float) -> str:
            meters = velocity.linear.x * seconds
            handle.publish_feedback(DriveOnHeading.Feedback(distance_traveled=meters))
            return f"{meters:.2f} m"

        message = await self.move(handle, velocity, goal.target.x / velocity.linear.x, report)
        return DriveOnHeading.Result(error_msg=message)


class CarpetServer(DriveServer):
    """A DriveServer on a thick carpet: it is ten times slower than it should be."""

    slower = 10.0


class SpinServer(TimedMover):
    """Offers /spin: turns by target_yaw radians, to the left where it's positive."""

    def __init__(self) -> None:
        super().__init__("spin_server", Spin, "/spin")

    async def execute(self, handle: ServerGoalHandle) -> Spin.Result:
        """Bring a goal to its end."""
        angle, velocity = handle.request.target_yaw, Twist()
        seconds = max(TICK, round(abs(angle) / TICK) * TICK)  # at about 1 rad/s
        velocity.angular.z = angle / seconds

        def report(so_far: float) -> str:
            radians = velocity.angular.z * so_far
            handle.publish_feedback(Spin.Feedback(angular_distance_traveled=radians))
            return f"{radians:.2f} rad"

        return Spin.Result(error_msg=await self.move(handle, velocity, seconds, report))
