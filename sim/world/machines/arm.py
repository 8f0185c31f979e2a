"""A planar arm with two joints, which moves to joint positions or along a trajectory."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from sim.world.bodies import Body
from sim.world.machines.machine import Machine, MachineWorld, Pose, bar
from sim.world.machines.servo import THICKNESS, Encoder, JointModel, Servo
from sim.world.machines.trajectory import Trajectory, Values, Waypoint
from sim.world.robot import RATE, CommandError, wrap
from sim.world.validated_model import Model


class ReachError(ValueError):
    """A point that the tip of the arm cannot reach."""


@dataclass(frozen=True)
class ArmModel(Model):
    """Two links in a row, each turned by a joint; the elbow's angle is 0 when the arm is straight.

    Points are in the arm's own frame: meters, the shoulder at the origin, x along the arm at angles 0, 0.

    Attributes:
        elbow_first: /joint_states lists the elbow first; the order of joints differs between drivers.
    """

    shoulder: JointModel = field(default_factory=JointModel)
    elbow: JointModel = field(default_factory=lambda: JointModel(lower=-2.5, upper=2.5, length=0.4))
    elbow_first: bool = False

    @property
    def joints(self) -> tuple[JointModel, JointModel]:
        """The joints from the base to the tip."""
        return self.shoulder, self.elbow

    @property
    def bodies(self) -> tuple[Body, ...]:
        """The two links, each with its x axis from its own joint to the next one or the tip."""
        return tuple(
            Body(name, "link", outline=bar(joint.length, THICKNESS))
            for name, joint in zip(("upper_arm", "forearm"), self.joints, strict=True)
        )

    def forward(self, shoulder: float, elbow: float) -> Pose:
        """Forward kinematics: the pose (x, y, yaw) of the tip at these angles (rad)."""
        x, y, yaw = self.elbow_pose(shoulder, elbow)
        return x + self.elbow.length * math.cos(yaw), y + self.elbow.length * math.sin(yaw), yaw

    def elbow_pose(self, shoulder: float, elbow: float) -> Pose:
        """The elbow's position and the forearm's direction at these angles (rad)."""
        upper = self.shoulder.length
        return upper * math.cos(shoulder), upper * math.sin(shoulder), wrap(shoulder + elbow)

    def inverse(self, x: float, y: float, elbow_left: bool = True) -> tuple[float, float]:
        """Inverse kinematics: the angles (rad) of shoulder and elbow for a position of the tip.

        elbow_left: of the two solutions, the one with a positive elbow angle. The joints' limits are not
        checked. Raises ReachError for a point that is too far away or too near.
        """
        upper, fore = self.shoulder.length, self.elbow.length
        distance = math.hypot(x, y)
        if not abs(upper - fore) <= distance <= upper + fore:
            raise ReachError(
                f"The tip can be {abs(upper - fore):g} to {upper + fore:g} m from the shoulder; "
                f"({x:g}, {y:g}) is {distance:.3g} m away: choose another place."
            )
        cosine = (x * x + y * y - upper * upper - fore * fore) / (2 * upper * fore)
        elbow = math.acos(min(max(cosine, -1.0), 1.0))
        if not elbow_left:
            elbow = -elbow
        inside = math.atan2(fore * math.sin(elbow), upper + fore * math.cos(elbow))
        return wrap(math.atan2(y, x) - inside), elbow


class Arm(Machine):
    """The simulated arm; `world.machine` is its `ArmModel`. The seed is for the encoders' noise."""

    def __init__(self, world: MachineWorld, seed: int = 0) -> None:
        super().__init__(world)
        self.model: ArmModel = world.machine
        self._servos, self._encoder = [Servo(joint) for joint in self.model.joints], Encoder(seed)
        self._reference = Trajectory([Waypoint(0.0, self.positions)])

    @property
    def poses(self) -> list[Pose]:
        """The poses of both links in the map frame."""
        shoulder, elbow = self.positions
        return [self._placed(0.0, 0.0, shoulder), self._placed(*self.model.elbow_pose(shoulder, elbow))]

    @property
    def positions(self) -> Values:
        """The joint angles (rad), shoulder first."""
        return tuple(servo.position for servo in self._servos)

    @property
    def velocities(self) -> Values:
        """The joint velocities, rad/s."""
        return tuple(servo.velocity for servo in self._servos)

    def measure(self) -> Values:
        """The encoders' measurements now: the angles (rad), then the velocities (rad/s), shoulder first."""
        return self._encoder.measure(*self._servos)

    @property
    def desired(self) -> tuple[Values, Values]:
        """The current reference positions (rad) and velocities (rad/s) of the joints."""
        return self._reference.at(self.time)

    def command(self, positions: Sequence[float]) -> None:
        """Set the target position (rad) of each joint, clamped to its limits.

        Raises:
            CommandError: not one finite number for each joint.
        """
        if len(positions) != len(self._servos) or not all(map(math.isfinite, positions)):
            raise CommandError(
                f"A command is one finite number (rad) for each of the {len(self._servos)} joints; this one "
                f"was {list(positions)}: check how it was calculated."
            )
        targets = zip(self._servos, positions, strict=True)
        self._set_target(servo.clamp(position) for servo, position in targets)

    def hold(self) -> None:
        """Decelerate as fast as possible and hold the position."""
        self._set_target(servo.stop for servo in self._servos)

    def follow(self, waypoints: Sequence[Waypoint], delay: float = 0.0) -> Trajectory:
        """Follow waypoints from the current positions, and hold the last one.

        Their times (s) are relative to now plus `delay` (s); waypoints in the past are skipped. Returns the
        trajectory, with times of the simulation.
        """
        begin = self.time + delay
        here = Waypoint(max(begin, self.time), self.positions, self.velocities)
        ahead = [point._replace(time=begin + point.time) for point in waypoints]
        ahead = [point for point in ahead[:-1] if point.time > here.time] + ahead[-1:]
        self._reference = Trajectory([here, *ahead])
        return self._reference

    def _set_target(self, positions: Iterable[float]) -> None:
        self._reference = Trajectory([Waypoint(self.time, tuple(positions))])

    def _step(self) -> None:
        positions, velocities = self._reference.at((self._steps + 1) / RATE)
        for servo, position, velocity in zip(self._servos, positions, velocities, strict=True):
            within = servo.clamp(position)
            servo.step(within, velocity if within == position else 0.0)
