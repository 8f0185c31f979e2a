"""An arm's action follow_joint_trajectory, as ROS's joint_trajectory_controller offers it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from builtin_interfaces.msg import Duration, Time
from control_msgs.action import FollowJointTrajectory
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.task import Future
from std_msgs.msg import Header
from trajectory_msgs.msg import JointTrajectoryPoint

from sim.nanoseconds import SECOND
from sim.ros.robots.machine_node import MachineNode
from sim.ros.robots.trajectory_goal import Goal, RejectedGoal, TrajectoryRequest, read_goal
from sim.world.machines.trajectory import Values

Result = FollowJointTrajectory.Result
STANDSTILL_RATE = 0.01
"""Below this rate (rad/s) a joint has arrived."""


class _ActiveGoal(NamedTuple):
    """The goal being executed, with its begin and end in the arm's time."""

    handle: ServerGoalHandle
    request: TrajectoryRequest
    begin: float
    end: float


class TrajectoryServer:
    """Executes one goal at a time; a newer goal replaces it.

    An invalid goal is rejected and the reason logged, because the response to a rejected goal has no field
    for it. Velocities and accelerations in tolerances are ignored.
    """

    def __init__(self, node: MachineNode, names: Sequence[str]) -> None:
        self._node, self._arm, self._names = node, node.scene, list(names)
        self._active: _ActiveGoal | None = None
        self._outcome = Future()  # of the active goal: how it ends, and its result
        self._outcomes: dict[bytes, Future] = {}  # by goal, until the result is returned
        self._server = ActionServer(
            node,
            FollowJointTrajectory,
            "arm_controller/follow_joint_trajectory",
            self._execute,
            goal_callback=self._judge,
            handle_accepted_callback=self._accepted,
            cancel_callback=self._cancel,
        )

    def abort_replaced(self, by: str) -> None:
        """Abort the active goal, if there is one, because of another command."""
        self._finish("abort", Result.INVALID_GOAL, f"The goal was replaced by {by}.")

    def watch(self, stamp: tuple[int, int]) -> None:
        """Publish feedback on the active goal, and end it when it is over; the stamp is (s, ns)."""
        active = self._active
        if active is None:
            return
        since, late = (round(self._arm.time - moment, 6) for moment in (active.begin, active.end))
        desired = self._arm.desired
        errors = tuple(
            target - actual for target, actual in zip(desired[0], self._arm.positions, strict=True)
        )
        self._report(active, stamp, desired, errors)
        name, error, tolerance = self._worst(errors, active.request.path)
        if abs(error) > tolerance and late <= 0:
            what = f"{name} was {abs(error):.3g} rad off its path; its tolerance is {tolerance:g} rad"
            self._stop(Result.PATH_TOLERANCE_VIOLATED, f"{since:.3g} s after the beginning {what}.")
        elif late >= 0:
            self._judge_end(active, errors, late)

    def _judge_end(self, active: _ActiveGoal, errors: Sequence[float], late: float) -> None:
        name, error, tolerance = self._worst(errors, active.request.goal)
        speed = max(map(abs, self._arm.velocities))
        if abs(error) <= tolerance and speed <= STANDSTILL_RATE:
            self._finish("succeed", Result.SUCCESSFUL, "The goal was reached.")
        elif late >= active.request.extra_time:
            what = f"{name} was {abs(error):.3g} rad from its goal; its tolerance is {tolerance:g} rad"
            if abs(error) <= tolerance:
                what = f"the arm was still moving, at {speed:.3g} rad/s"
            self._stop(Result.GOAL_TOLERANCE_VIOLATED, f"{late:.3g} s after the end {what}.")

    def _worst(self, errors: Sequence[float], tolerances: Sequence[float]) -> tuple[str, float, float]:
        """The joint that exceeds its tolerance most, its error, and the tolerance."""
        return max(zip(self._names, errors, tolerances, strict=True), key=lambda row: abs(row[1]) - row[2])

    def _report(
        self, active: _ActiveGoal, stamp: tuple[int, int], desired: tuple[Values, Values], errors: Values
    ) -> None:
        arm = self._arm
        since = round(max(arm.time - active.begin, 0.0) * SECOND)
        rate_errors = tuple(
            target - actual for target, actual in zip(desired[1], arm.velocities, strict=True)
        )
        points = [
            JointTrajectoryPoint(
                positions=positions,
                velocities=velocities,
                time_from_start=Duration(sec=since // SECOND, nanosec=since % SECOND),
            )
            for positions, velocities in (desired, (arm.positions, arm.velocities), (errors, rate_errors))
        ]
        header = Header(stamp=Time(sec=stamp[0], nanosec=stamp[1]))
        feedback = FollowJointTrajectory.Feedback(header=header, joint_names=self._names)
        feedback.desired, feedback.actual, feedback.error = points
        active.handle.publish_feedback(feedback)

    # -- the action server's callbacks -------------------------------------------------------------

    def _read(self, goal: Goal) -> TrajectoryRequest:
        now = self._node.get_clock().now().nanoseconds
        return read_goal(goal, self._names, self._arm.model.joints, now)

    def _judge(self, goal: Goal) -> GoalResponse:
        try:
            self._read(goal)
        except RejectedGoal as error:
            self._node.get_logger().error(f"Goal rejected, {error.code}: {error}")
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def _accepted(self, handle: ServerGoalHandle) -> None:
        self.abort_replaced("a newer one")
        request = self._read(handle.request)
        trajectory = self._arm.follow(request.waypoints, request.delay)
        begin = trajectory.end - request.waypoints[-1].time
        self._active = _ActiveGoal(handle, request, begin, trajectory.end)
        self._outcomes[bytes(handle.goal_id.uuid)] = self._outcome = Future()
        handle.execute()

    def _cancel(self, handle: ServerGoalHandle) -> CancelResponse:
        if self._active is None or self._active.handle != handle:
            return CancelResponse.REJECT  # it has just ended
        self._arm.hold()
        self._finish("canceled", Result.SUCCESSFUL, "The goal was canceled; the arm stops and stays.")
        return CancelResponse.ACCEPT

    async def _execute(self, handle: ServerGoalHandle) -> Any:
        how, result = await self._outcomes.pop(bytes(handle.goal_id.uuid))
        getattr(handle, how)()
        return result

    # -- endings -----------------------------------------------------------------------------------

    def _stop(self, code: int, text: str) -> None:
        self._arm.hold()
        self._finish("abort", code, text)

    def _finish(self, how: str, code: int, text: str) -> None:
        """End the active goal; `how` is the name of a ServerGoalHandle's method."""
        active, self._active = self._active, None
        if active is not None:
            self._outcome.set_result((how, Result(error_code=code, error_string=text)))
