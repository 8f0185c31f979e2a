"""Clients that send goals to a student's action server, one after the other."""

import random
from typing import Any, NamedTuple

from example_interfaces.action import Fibonacci
from nav2_msgs.action import Spin
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.task import Future

STATUS = {4: "succeeded", 5: "canceled", 6: "aborted"}
PAUSE = 1.0  # seconds between the end of a goal and the next one


class PlannedGoal(NamedTuple):
    """A goal to send; after so many seconds its client requests to cancel it."""

    goal: Any
    patience: float | None = None


class ActionGoalSender(Node):
    """Sends its goals one after the other: the next one when the one before has ended."""

    name, action, type = "goal_sender", "/fibonacci", Fibonacci

    def __init__(self) -> None:
        super().__init__(self.name)
        self.client = ActionClient(self, self.type, self.action)
        self.planned_goals = self.plan()
        self.idle = PAUSE  # seconds since the last goal ended
        self.create_timer(0.1, self.tick)

    def plan(self) -> list[PlannedGoal]:
        """Return what to send; from the seed of the run."""
        raise NotImplementedError

    def tick(self) -> None:
        """Send the next goal, if it is time."""
        self.idle += 0.1
        if self.planned_goals and self.idle >= PAUSE and self.client.server_is_ready():
            self.idle = float("-inf")
            planned = self.planned_goals.pop(0)
            future = self.client.send_goal_async(planned.goal)
            future.add_done_callback(lambda future: self.on_response(future, planned))

    def on_response(self, future: Future, planned: PlannedGoal) -> None:
        """Handle the server's decision on the goal."""
        handle = future.result()
        if not handle.accepted:
            self.finish(planned, "rejected")
            return
        handle.get_result_async().add_done_callback(lambda future: self.on_result(future, planned))
        if planned.patience is not None:
            self.cancel_later(handle, planned, planned.patience)

    def cancel_later(self, handle: Any, planned: PlannedGoal, patience: float) -> None:
        """Request once to cancel a goal."""

        def cancel() -> None:
            timer.cancel()
            self.get_logger().info(f"{words(planned.goal)}: please cancel it")
            handle.cancel_goal_async()

        timer = self.create_timer(patience, cancel)

    def on_result(self, future: Future, planned: PlannedGoal) -> None:
        """Handle the end of the goal."""
        answer = future.result()
        self.finish(planned, f"{STATUS.get(answer.status, 'unknown')} {words(answer.result)}")

    def finish(self, planned: PlannedGoal, how: str) -> None:
        """Log how a goal ended, and be ready for the next one."""
        self.get_logger().info(f"{words(planned.goal)}: {how}")
        self.idle = 0.0


def words(message: Any) -> str:
    """A goal or result in one line."""
    if hasattr(message, "order"):
        return f"order {message.order}"
    if hasattr(message, "sequence"):
        numbers = [str(number) for number in message.sequence]
        return f"[{', '.join(numbers if len(numbers) < 16 else [*numbers[:8], '...', numbers[-1]])}]"
    if hasattr(message, "target_yaw"):
        return f"turn by {message.target_yaw:.2f} rad"
    return message.error_msg and f"({message.error_msg})"


class Mathematician(ActionGoalSender):
    """Sends two goals with an order of 3 to 20 to /fibonacci."""

    name = "mathematician"

    def plan(self) -> list[PlannedGoal]:
        """Two different orders."""
        return [PlannedGoal(Fibonacci.Goal(order=order)) for order in random.sample(range(3, 21), 2)]


class Examiner(ActionGoalSender):
    """Sends goals with good and bad orders to /fibonacci, some of them just at the limits 1 and 20."""

    name = "examiner"

    def plan(self) -> list[PlannedGoal]:
        """The last one takes the longest."""
        orders = [random.randint(4, 6), 0, 21, 1, -random.randint(1, 9), random.randint(50, 99), 20]
        return [PlannedGoal(Fibonacci.Goal(order=order)) for order in orders]


class Impatient(ActionGoalSender):
    """Sends a long goal to /fibonacci, cancels it on the way, and then sends a short one."""

    name = "impatient"

    def plan(self) -> list[PlannedGoal]:
        """The moment of the cancel comes from the seed of the run."""
        return [
            PlannedGoal(Fibonacci.Goal(order=20), patience=random.uniform(1.6, 3.4)),
            PlannedGoal(Fibonacci.Goal(order=random.randint(3, 6))),
        ]


class Captain(ActionGoalSender):
    """Sends four goals to /spin: to the left, to the right, by more than half a turn, and one it cancels."""

    name, action, type = "captain", "/spin", Spin

    def plan(self) -> list[PlannedGoal]:
        """Angles in radians."""
        return [
            PlannedGoal(Spin.Goal(target_yaw=random.uniform(0.8, 1.5))),
            PlannedGoal(Spin.Goal(target_yaw=-random.uniform(1.0, 2.0))),
            PlannedGoal(Spin.Goal(target_yaw=random.uniform(3.6, 4.6))),
            PlannedGoal(Spin.Goal(target_yaw=9.0), patience=random.uniform(1.5, 2.5)),
        ]
