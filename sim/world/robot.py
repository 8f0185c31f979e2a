"""The robot's figures, and the drive that moves its body through the physics."""

import itertools
import math
import re
from dataclasses import dataclass
from typing import Annotated, NamedTuple

import pymunk

from sim.world.model import Angle, Coordinate, Length, Model, Wanted, above, within
from sim.world.obstacles import Point

Pose = tuple[Coordinate, Coordinate, Angle]

RATE = 100
"""Physics steps in a second."""
DT = 1 / RATE
"""Length of a physics step, s."""


_NAME = "a name of small letters, digits and single underscores that begins with a letter"
_ROUTE = "[[x, y], ...], two or more corners (metres), each different from the one before"


def _is_loop(route: tuple[Point, ...]) -> bool:
    corners = (*route, *route[:1])
    return not route or (len(route) >= 2 and all(a != b for a, b in itertools.pairwise(corners)))


class CommandError(ValueError):
    """A velocity command is not a pair of finite numbers."""


@dataclass(frozen=True)
class RobotModel(Model):
    """A small differential-drive robot, a disc seen from above (m, kg, s, rad, N)."""

    radius: Length = 0.1
    mass: Annotated[float, above(0, "kg")] = 1.0
    wheel_radius: Length = 0.033
    track_width: Length = 0.16
    max_v: Annotated[float, above(0, "m/s")] = 0.6
    max_w: Annotated[float, above(0, "rad/s")] = 2.5
    max_acceleration: Annotated[float, above(0, "m/s^2")] = 2.0
    max_angular_acceleration: Annotated[float, above(0, "rad/s^2")] = 8.0
    command_timeout: Annotated[float, within(DT, 1000, "seconds")] = 0.5
    max_force: Annotated[float, above(0, "N")] = 5.0
    max_torque: Annotated[float, above(0, "N m")] = 0.25
    friction: Annotated[float, within(0, 10)] = 0.3

    @property
    def inertia(self) -> float:
        """Moment of inertia about its centre, kg m^2."""
        return self.mass * self.radius**2 / 2

    def __post_init__(self) -> None:
        super().__post_init__()
        # A faster robot could pass through a thin wall between two steps.
        if self.max_v * DT > self.radius:
            self.refuse(
                "max_v", f"{self.radius / DT:g} m/s or less, one radius in a physics step of {DT:g} s"
            )
        # Where the wheels' grip can't do what ramps and curves ask for, odometry drifts without a collision.
        force = self.mass * math.hypot(self.max_acceleration, self.max_v * self.max_w)
        if self.max_force <= force:
            self.refuse("max_force", f"more than {force:g} N, which the robot's ramps and curves need")
        torque = self.inertia * self.max_angular_acceleration
        if self.max_torque <= torque:
            self.refuse("max_torque", f"more than {torque:g} N m, which the robot's ramps need")


@dataclass(frozen=True)
class OtherRobot(Model):
    """A further robot like the first, in a namespace of its own.

    `start` is (x, y, yaw) in the map frame. A robot with a `route`, corners (x, y) in the map frame, drives
    round it at `speed` (m/s); one without waits for commands on /NAME/cmd_vel.
    """

    name: Annotated[str, Wanted(_NAME, re.compile(r"[a-z][a-z0-9]*(_[a-z0-9]+)*").fullmatch)]
    start: Annotated[Pose, Wanted("[x, y, yaw] (metres and radians)")]
    route: Annotated[tuple[Point, ...], Wanted(_ROUTE, _is_loop)] = ()
    speed: Annotated[float, above(0, "m/s")] = 0.2


class Odometry(NamedTuple):
    """Where the wheels say the robot is: pose in odom (m, rad), velocity in base_link (m/s, rad/s)."""

    x: float
    y: float
    yaw: float
    v: float
    w: float


class Wheels(NamedTuple):
    """The two wheel joints: angles (rad, not wrapped) and rates (rad/s), positive when rolling forwards."""

    left: float
    right: float
    left_rate: float
    right_rate: float


class Drive:
    """Two driven wheels under the robot's body.

    The wheels are a kinematic body that the robot's body is tied to by joints of finite force. So the wheels
    always do what they are told, and the body follows as long as nothing holds it. Were the body's own
    velocity set instead, it would sink into walls.
    """

    def __init__(self, space: pymunk.Space, model: RobotModel, start: tuple[float, float, float]) -> None:
        self._model = model
        self.body, self.shape = _body(model, start)
        self._wheels = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
        self._wheels.position = self.body.position
        space.add(self.body, self.shape, self._wheels, *_joints(self._wheels, self.body, model))
        self._v = self._w = 0.0
        self._target_v = self._target_w = 0.0
        self._steps_left = 0
        self._x = self._y = 0.0
        self._distance = self._turn = 0.0

    def command(self, v: float, w: float) -> None:
        """Aim for v (m/s, forwards) and w (rad/s, counter-clockwise), each cut to the model's limit.

        Raises:
            CommandError: v or w is infinite or not a number.
        """
        if not (math.isfinite(v) and math.isfinite(w)):
            raise CommandError(
                f"Velocity commands are finite numbers; this one was {v} m/s and {w} rad/s: "
                "check how it was worked out."
            )
        model = self._model
        self._target_v = min(max(v, -model.max_v), model.max_v)
        self._target_w = min(max(w, -model.max_w), model.max_w)
        self._steps_left = round(model.command_timeout * RATE)

    def roll(self) -> None:
        """Roll the wheels through one step; call before each step of the space."""
        v, w = self._v, self._w
        stride, half_turn = _chord(v, w)
        heading = self._turn + half_turn
        self._x += stride * DT * math.cos(heading)
        self._y += stride * DT * math.sin(heading)
        self._distance += v * DT
        self._turn += w * DT

        if self._steps_left:
            self._steps_left -= 1
        else:
            self._target_v = self._target_w = 0.0
        model = self._model
        self._v = v = _toward(v, self._target_v, model.max_acceleration * DT)
        self._w = w = _toward(w, self._target_w, model.max_angular_acceleration * DT)

        # A step of pymunk first moves the body at its old velocity and then solves for the new one, which is
        # thus used from the pose at the end of this step: that pose's heading is the one to aim from.
        body = self.body
        stride, half_turn = _chord(v, w)
        heading = body.angle + body.angular_velocity * DT + half_turn
        self._wheels.velocity = (stride * math.cos(heading), stride * math.sin(heading))
        self._wheels.angular_velocity = w

    @property
    def odometry(self) -> Odometry:
        """The pose and speed that follow from the wheels alone."""
        return Odometry(self._x, self._y, wrap(self._turn), self._v, self._w)

    @property
    def wheels(self) -> Wheels:
        """The state of the wheel joints."""
        radius, lever = self._model.wheel_radius, self._model.track_width / 2
        return Wheels(
            (self._distance - lever * self._turn) / radius,
            (self._distance + lever * self._turn) / radius,
            (self._v - lever * self._w) / radius,
            (self._v + lever * self._w) / radius,
        )


def wrap(angle: float) -> float:
    """The same angle (rad) in (-pi, pi]."""
    angle = math.remainder(angle, math.tau)
    return angle if angle > -math.pi else math.pi


def _chord(v: float, w: float) -> tuple[float, float]:
    """Speed along the chord of one step's arc, and the chord's angle to the heading at the step's start."""
    half_turn = w * DT / 2
    return (v * math.sin(half_turn) / half_turn if half_turn else v), half_turn


def _toward(now: float, target: float, most: float) -> float:
    """Step from now to target, by at most `most`."""
    if target > now + most:
        return now + most
    if target < now - most:
        return now - most
    return target


def _body(model: RobotModel, start: tuple[float, float, float]) -> tuple[pymunk.Body, pymunk.Circle]:
    body = pymunk.Body(model.mass, pymunk.moment_for_circle(model.mass, 0, model.radius))
    body.position = start[:2]
    body.angle = start[2]
    shape = pymunk.Circle(body, model.radius)
    shape.friction = model.friction
    return body, shape


def _joints(wheels: pymunk.Body, body: pymunk.Body, model: RobotModel) -> tuple[pymunk.Constraint, ...]:
    pivot = pymunk.PivotJoint(wheels, body, (0, 0), (0, 0))
    pivot.max_force = model.max_force
    gear = pymunk.GearJoint(wheels, body, 0, 1)
    gear.max_force = model.max_torque
    for joint in (pivot, gear):
        # The joints pass on velocity only: a body that was held back is not pulled after the wheels later.
        joint.max_bias = 0
        joint.collide_bodies = False
    return pivot, gear
