"""The differential drive of a robot in the physics, and its wheel odometry."""

import math

import pymunk

from sim.world.robot import DT, RATE, CommandError, Odometry, Pose, RobotModel, WheelJoints, wrap
from sim.world.wheels import Wheels

# Calls to these setters are faster than assignments, for which pymunk checks the attribute's name each time.
_set_velocity, _set_angular_velocity = pymunk.Body.velocity.fset, pymunk.Body.angular_velocity.fset  # type: ignore[attr-defined]


class Drive:
    """Two driven wheels under the robot's body.

    The wheels are a kinematic body, coupled to the robot's body by joints of finite force. So the wheels
    always move at the commanded velocity, and the body follows unless an obstacle holds it. If the body's own
    velocity were set instead, the body would penetrate walls.

    imperfect: wheels whose odometry drifts; None if the wheels are what the model says.

    Attributes:
        body, shape: the robot in the physics.
    """

    def __init__(
        self, space: pymunk.Space, model: RobotModel, start: Pose, imperfect: Wheels | None = None
    ) -> None:
        self._model, self._imperfect, self._space = model, imperfect, space
        self.body, self.shape = _body(model, start)
        self._wheels = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
        self._wheels.position = self.body.position
        space.add(self.body, self.shape, self._wheels, *_joints(self._wheels, self.body, model))
        self._v = self._w = 0.0
        self._chord = _chord(0.0, 0.0)
        self._target_v = self._target_w = 0.0
        self._steps_left = 0
        self._x, self._y, self._turn = model.odometry
        self._distance = 0.0

    def command(self, v: float, w: float) -> None:
        """Set the target velocity v (m/s, forwards) and w (rad/s, counter-clockwise), clamped to the limits.

        The velocity ramps towards it. `command_timeout` (s) after the last command it ramps down to 0.

        Raises:
            CommandError: v or w is infinite or not a number.
        """
        if not (math.isfinite(v) and math.isfinite(w)):
            raise CommandError(
                f"Velocity commands are finite numbers; this one was {v} m/s and {w} rad/s: check how it was "
                "calculated."
            )
        model = self._model
        self._target_v = min(max(v, -model.max_v), model.max_v)
        self._target_w = min(max(w, -model.max_w), model.max_w)
        self._steps_left = round(model.command_timeout * RATE)

    def roll(self) -> None:
        """Advance the wheels by one step; call before each step of the space."""
        v, w = self._v, self._w
        stride, half_turn = self._chord
        heading = self._turn + half_turn
        self._x += stride * DT * math.cos(heading)
        self._y += stride * DT * math.sin(heading)
        self._distance += v * DT
        self._turn += w * DT
        if self._imperfect:
            self._imperfect.count(v, w)

        if self._steps_left:
            self._steps_left -= 1
        else:
            self._target_v = self._target_w = 0.0
        model = self._model
        self._v = v = _toward(v, self._target_v, model.max_acceleration * DT)
        self._w = w = _toward(w, self._target_w, model.max_angular_acceleration * DT)

        # A step of pymunk first moves the body at its old velocity and then solves for the new one. So the
        # new velocity applies from the pose at the end of this step, and its direction is relative to that
        # heading.
        body = self.body
        if self._imperfect:
            v, w = self._imperfect.on_ground(v, w)
        self._chord = stride, half_turn = _chord(v, w)
        heading = body.angle + body.angular_velocity * DT + half_turn
        _set_velocity(self._wheels, (stride * math.cos(heading), stride * math.sin(heading)))
        _set_angular_velocity(self._wheels, w)

    def place(self, x: float, y: float, yaw: float) -> None:
        """Put the robot down at a pose in the map (m, rad); its odometry doesn't notice."""
        body = self.body
        body.position, body.angle = (x, y), yaw
        body.velocity, body.angular_velocity = (0.0, 0.0), 0.0
        self._space.reindex_shapes_for_body(body)

    @property
    def odometry(self) -> Odometry:
        """Wheel odometry, starting at the model's `odometry`; it drifts once an obstacle held the robot."""
        if self._imperfect:
            return self._imperfect.odometry
        return Odometry(self._x, self._y, wrap(self._turn), self._v, self._w)

    @property
    def wheels(self) -> WheelJoints:
        """Angles and rates of the two wheel joints."""
        if self._imperfect:
            return self._imperfect.joints
        radius, lever = self._model.wheel_radius, self._model.track_width / 2
        turned = lever * (self._turn - self._model.odometry[2])
        return WheelJoints(
            (self._distance - turned) / radius,
            (self._distance + turned) / radius,
            (self._v - lever * self._w) / radius,
            (self._v + lever * self._w) / radius,
        )


def _chord(v: float, w: float) -> tuple[float, float]:
    """Speed along the chord of one step's arc, and the chord's angle to the heading at the step's start."""
    half_turn = w * DT / 2
    return (v * math.sin(half_turn) / half_turn if half_turn else v), half_turn


def _toward(now: float, target: float, most: float) -> float:
    """`now` changed towards `target` by at most `most`."""
    if target > now + most:
        return now + most
    if target < now - most:
        return now - most
    return target


def _body(model: RobotModel, start: Pose) -> tuple[pymunk.Body, pymunk.Circle]:
    body = pymunk.Body(model.mass, model.inertia)
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
        # The joints have no position correction: a body that was held back doesn't catch up with the wheels.
        joint.max_bias = 0
        joint.collide_bodies = False
    return pivot, gear
