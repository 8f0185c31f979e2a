"""The action follow_joint_trajectory of an arm, as ROS's joint_trajectory_controller offers it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from builtin_interfaces.msg import Duration, Time
from control_msgs.action import FollowJointTrajectory
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.task import Future
from std_msgs.msg import Header
from trajectory_msgs.msg import JointTrajectoryPoint

from sim.nanoseconds import SECOND
from sim.ros.robots.trajectory_goal import Goal, Order, RefusedError, read
from sim.world.machines.trajectory import Values

if TYPE_CHECKING:
    from sim.ros.robots.machine import MachineNode

Result = FollowJointTrajectory.Result
STANDS = 0.01
"""Below this rate (rad/s) a joint has arrived."""


class _Pursuit(NamedTuple):
    """A goal under way. Times are the arm's own."""

    handle: ServerGoalHandle
    order: Order
    begin: float
    end: float


class TrajectoryServer:
    """Follows one goal at a time; a newer one takes over.

    A goal that can't be followed is rejected, and the reason is logged: ROS 2 has no answer to a rejected
    goal that could hold it. Velocities and accelerations in tolerances aren't looked at.
    """

    def __init__(self, node: MachineNode, names: Sequence[str]) -> None:
        self._node, self._arm, self._names = node, node.scene, list(names)
        self._pursuit: _Pursuit | None = None
        self._outcome = Future()  # of the pursuit: how it ends and its result
        self._outcomes: dict[bytes, Future] = {}  # by goal, until it has been told
        self._server = ActionServer(
            node,
            FollowJointTrajectory,
            "arm_controller/follow_joint_trajectory",
            self._execute,
            goal_callback=self._judge,
            handle_accepted_callback=self._accepted,
            cancel_callback=self._cancel,
        )

    def replaced(self, by: str) -> None:
        """The arm has been told to do something else: end the goal under way, if there is one."""
        self._finish("abort", Result.INVALID_GOAL, f"The goal was replaced by {by}.")

    def watch(self, stamp: tuple[int, int]) -> None:
        """Tell the client how the goal under way is doing, and end it if it is over; the stamp is (s, ns)."""
        pursuit = self._pursuit
        if pursuit is None:
            return
        since, late = (round(self._arm.time - moment, 6) for moment in (pursuit.begin, pursuit.end))
        desired = self._arm.desired
        errors = tuple(wanted - real for wanted, real in zip(desired[0], self._arm.positions, strict=True))
        self._report(pursuit, stamp, desired, errors)
        name, error, tolerance = self._worst(errors, pursuit.order.path)
        if abs(error) > tolerance and late <= 0:
            what = f"{name} was {abs(error):.3g} rad off its path; its tolerance is {tolerance:g} rad"
            self._stop(Result.PATH_TOLERANCE_VIOLATED, f"{since:.3g} s after the beginning {what}.")
        elif late >= 0:
            self._judge_end(pursuit, errors, late)

    def _judge_end(self, pursuit: _Pursuit, errors: Sequence[float], late: float) -> None:
        name, error, tolerance = self._worst(errors, pursuit.order.goal)
        speed = max(map(abs, self._arm.velocities))
        if abs(error) <= tolerance and speed <= STANDS:
            self._finish("succeed", Result.SUCCESSFUL, "The goal was reached.")
        elif late >= pursuit.order.patience:
            what = f"{name} was {abs(error):.3g} rad from its goal; its tolerance is {tolerance:g} rad"
            if abs(error) <= tolerance:
                what = f"the arm still moved, at {speed:.3g} rad/s"
            self._stop(Result.GOAL_TOLERANCE_VIOLATED, f"{late:.3g} s after the end {what}.")

    def _worst(self, errors: Sequence[float], tolerances: Sequence[float]) -> tuple[str, float, float]:
        """The joint that is furthest beyond its tolerance, by how much it is off, and the tolerance."""
        return max(zip(self._names, errors, tolerances, strict=True), key=lambda row: abs(row[1]) - row[2])

    def _report(
        self, pursuit: _Pursuit, stamp: tuple[int, int], desired: tuple[Values, Values], errors: Values
    ) -> None:
        arm = self._arm
        since = round(max(arm.time - pursuit.begin, 0.0) * SECOND)
        off = tuple(wanted - real for wanted, real in zip(desired[1], arm.velocities, strict=True))
        points = [
            JointTrajectoryPoint(
                positions=positions,
                velocities=velocities,
                time_from_start=Duration(sec=since // SECOND, nanosec=since % SECOND),
            )
            for positions, velocities in (desired, (arm.positions, arm.velocities), (errors, off))
        ]
        header = Header(stamp=Time(sec=stamp[0], nanosec=stamp[1]))
        feedback = FollowJointTrajectory.Feedback(header=header, joint_names=self._names)
        feedback.desired, feedback.actual, feedback.error = points
        pursuit.handle.publish_feedback(feedback)

    # -- the action server's callbacks -------------------------------------------------------------

    def _read(self, goal: Goal) -> Order:
        now = self._node.get_clock().now().nanoseconds
        return read(goal, self._names, self._arm.model.joints, now)

    def _judge(self, goal: Goal) -> GoalResponse:
        try:
            self._read(goal)
        except RefusedError as error:
            self._node.get_logger().error(f"Goal rejected, {error.code}: {error}")
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def _accepted(self, handle: ServerGoalHandle) -> None:
        self.replaced("a newer one")
        order = self._read(handle.request)
        trajectory = self._arm.follow(order.waypoints, order.delay)
        begin = trajectory.end - order.waypoints[-1].time
        self._pursuit = _Pursuit(handle, order, begin, trajectory.end)
        self._outcomes[bytes(handle.goal_id.uuid)] = self._outcome = Future()
        handle.execute()

    def _cancel(self, handle: ServerGoalHandle) -> CancelResponse:
        if self._pursuit is None or self._pursuit.handle != handle:
            return CancelResponse.REJECT  # it has just ended
        self._arm.hold()
        self._finish("canceled", Result.SUCCESSFUL, "The goal was canceled; the arm stops and stays.")
        return CancelResponse.ACCEPT

    async def _execute(self, handle: ServerGoalHandle) -> Result:
        how, result = await self._outcomes.pop(bytes(handle.goal_id.uuid))
        getattr(handle, how)()
        return result

    # -- endings -----------------------------------------------------------------------------------

    def _stop(self, code: int, text: str) -> None:
        self._arm.hold()
        self._finish("abort", code, text)

    def _finish(self, how: str, code: int, text: str) -> None:
        """Let the goal under way end: how is the name of a ServerGoalHandle's method."""
        pursuit, self._pursuit = self._pursuit, None
        if pursuit is not None:
            self._outcome.set_result((how, Result(error_code=code, error_string=text)))
