"""The action rotate_absolute of a turtle."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.task import Future
from turtlesim.action import RotateAbsolute

from sim.world.machines import Rotation, Turtle

if TYPE_CHECKING:
    from sim.ros.robots.turtlesim import Turtlesim


class RotateServer:
    """Turns a turtle to headings, one at a time: a new goal or a velocity ends the one under way."""

    def __init__(self, node: Turtlesim, turtle: Turtle) -> None:
        self._node, self._turtle = node, turtle
        self._handle: ServerGoalHandle | None = None  # of the goal under way
        self._rotation: Rotation | None = None
        self._outcomes: dict[bytes, Future] = {}  # of goals that aren't over, by id
        self._running = 0
        self._server = ActionServer(
            node,
            RotateAbsolute,
            f"{turtle.name}/rotate_absolute",
            self._execute,
            goal_callback=self._judge,
            handle_accepted_callback=self._accepted,
            cancel_callback=lambda handle: CancelResponse.ACCEPT,
        )

    def watch(self) -> None:
        """Tell the client how the goal under way is doing, and end it if it is over."""
        handle, rotation = self._handle, self._rotation
        if handle is None:
            return
        if handle.is_cancel_requested:
            self._node.get_logger().info("Rotation goal canceled")
            self._turtle.stop()
            self._finish("canceled")
            return
        handle.publish_feedback(RotateAbsolute.Feedback(remaining=rotation.remaining))
        if rotation.done:
            self._node.get_logger().info("Rotation goal completed successfully")
            self._finish("succeed")

    def replaced(self, words: str) -> None:
        """The turtle has been told to do something else: end the goal under way, if there is one."""
        if self._handle is not None:
            self._node.get_logger().warning(words)
            self._finish("abort")

    def leave(self) -> None:
        """The turtle leaves: the goal under way comes to nothing."""
        if self._handle is not None:
            self._finish("abort")

    def gone(self) -> bool:
        """Whether all is told and the action is there no more."""
        if self._running:
            return False
        self._server.destroy()
        return True

    def _judge(self, goal: RotateAbsolute.Goal) -> GoalResponse:
        if math.isfinite(goal.theta):
            return GoalResponse.ACCEPT
        self._node.get_logger().error(
            f"Headings are finite numbers; this one was {goal.theta:g}: check how it was worked out."
        )
        return GoalResponse.REJECT

    def _accepted(self, handle: ServerGoalHandle) -> None:
        self.replaced("Rotation goal received before a previous goal finished. Aborting previous goal")
        self._handle, self._rotation = handle, self._turtle.rotate(handle.request.theta)
        self._outcomes[bytes(handle.goal_id.uuid)] = Future()
        self._running += 1
        handle.execute()

    def _finish(self, how: str) -> None:
        """Let the goal under way end: how is the name of a ServerGoalHandle's method."""
        handle, self._handle = self._handle, None
        result = RotateAbsolute.Result(delta=self._rotation.delta)
        self._outcomes.pop(bytes(handle.goal_id.uuid)).set_result((how, result))

    async def _execute(self, handle: ServerGoalHandle) -> RotateAbsolute.Result:
        how, result = await self._outcomes[bytes(handle.goal_id.uuid)]
        getattr(handle, how)()
        self._running -= 1
        return result
