"""A turtle's action rotate_absolute."""

from __future__ import annotations

import math

from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.node import Node
from rclpy.task import Future
from turtlesim.action import RotateAbsolute

from sim.world.machines import Rotation, Turtle


class RotateServer:
    """Turns a turtle to a heading; a new goal or a velocity command aborts the active goal."""

    def __init__(self, node: Node, turtle: Turtle) -> None:
        self._node, self._turtle = node, turtle
        self._handle: ServerGoalHandle | None = None  # of the active goal
        self._rotation: Rotation | None = None
        self._outcomes: dict[bytes, Future] = {}  # of unfinished goals, by id
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
        """Publish feedback on the active goal, and end it when it is over."""
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

    def abort_replaced(self, warning: str) -> None:
        """Abort the active goal, if there is one, and log this warning."""
        if self._handle is not None:
            self._node.get_logger().warning(warning)
            self._finish("abort")

    def abort_leaving(self) -> None:
        """Abort the active goal, because the turtle is removed."""
        if self._handle is not None:
            self._finish("abort")

    def close_if_idle(self) -> bool:
        """Destroy the action server if all results are sent; returns whether it did."""
        if self._running:
            return False
        self._server.destroy()
        return True

    def _judge(self, goal: RotateAbsolute.Goal) -> GoalResponse:
        if math.isfinite(goal.theta):
            return GoalResponse.ACCEPT
        self._node.get_logger().error(
            f"Headings are finite numbers; this one was {goal.theta:g}: check how it was calculated."
        )
        return GoalResponse.REJECT

    def _accepted(self, handle: ServerGoalHandle) -> None:
        self.abort_replaced("Rotation goal received before a previous goal finished. Aborting previous goal")
        self._handle, self._rotation = handle, self._turtle.rotate(handle.request.theta)
        self._outcomes[bytes(handle.goal_id.uuid)] = Future()
        self._running += 1
        handle.execute()

    def _finish(self, how: str) -> None:
        """End the active goal; `how` is the name of a ServerGoalHandle's method."""
        handle, self._handle = self._handle, None
        result = RotateAbsolute.Result(delta=self._rotation.delta)
        self._outcomes.pop(bytes(handle.goal_id.uuid)).set_result((how, result))

    async def _execute(self, handle: ServerGoalHandle) -> RotateAbsolute.Result:
        how, result = await self._outcomes[bytes(handle.goal_id.uuid)]
        getattr(handle, how)()
        self._running -= 1
        return result
