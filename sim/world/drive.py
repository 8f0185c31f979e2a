"""The drive that moves a robot's body through the physics."""

import math

import pymunk

from sim.world.robot import DT, RATE, CommandError, Odometry, Pose, RobotModel, Wheels, wrap

# As an assignment, for which pymunk looks at the attribute's name each time.
_set_velocity, _set_angular_velocity = pymunk.Body.velocity.fset, pymunk.Body.angular_velocity.fset

class Drive:
    """Two driven wheels under the robot's body.

    The wheels are a kinematic body that the robot's body is tied to by joints of finite force. So the wheels
    always do what they are told, and the body follows as long as nothing holds it. Were the body's own
    velocity set instead, it would sink into walls.

    Attributes:
        body, shape: the robot in the physics.
    """

    def __init__(self, space: pymunk.Space, model: RobotModel, start: Pose) -> None:
        self._model = model
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
        """From now on, drive at v (m/s, forwards) and w (rad/s, counter-clockwise), within the limits.

        The speed ramps up to it. `command_timeout` (s) after the last command it ramps down to 0.

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
        stride, half_turn = self._chord
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
        self._chord = stride, half_turn = _chord(v, w)
        heading = body.angle + body.angular_velocity * DT + half_turn
        _set_velocity(self._wheels, (stride * math.cos(heading), stride * math.sin(heading)))
        _set_angular_velocity(self._wheels, w)

    @property
    def odometry(self) -> Odometry:
        """Where the wheels say the robot is, from the model's `odometry` on; wrong once something held it."""
        return Odometry(self._x, self._y, wrap(self._turn), self._v, self._w)

    @property
    def wheels(self) -> Wheels:
        """Angles and rates of the two wheel joints."""
        radius, lever = self._model.wheel_radius, self._model.track_width / 2
        turned = lever * (self._turn - self._model.odometry[2])
        return Wheels(
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
    """Step from now to target, by at most `most`."""
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
        # The joints pass on velocity only: a body that was held back is not pulled after the wheels later.
        joint.max_bias = 0
        joint.collide_bodies = False
    return pivot, gear
