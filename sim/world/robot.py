"""Parameters of mobile robots, their odometry and their wheel joints."""

import math
import re
from dataclasses import dataclass
from typing import Annotated, NamedTuple

from sim.world.obstacles import Point, ring
from sim.world.validated_model import Angle, Constraint, Coordinate, Length, Model, at_least, positive, within

Pose = tuple[Coordinate, Coordinate, Angle]
Carry = tuple[Annotated[float, at_least(0, "s")], Coordinate, Coordinate, Angle]

RATE = 100
"""Physics steps per second."""
DT = 1 / RATE
"""Length of a physics step, s."""


_NAME = "a name of small letters, digits and single underscores that begins with a letter"
ROUTE = "[[x, y], ...], two or more corners (meters), each different from the one before"


def is_loop(route: tuple[Point, ...]) -> bool:
    """Return whether corners form a closed route; no corners, which mean no route, are valid too."""
    return not route or (len(route) >= 2 and all(a != b for a, b in ring(route)))


class CommandError(ValueError):
    """A velocity command is not a pair of finite numbers."""


@dataclass(frozen=True)
class RobotModel(Model):
    """A small differential-drive robot, a disc seen from above (m, kg, s, rad, N).

    `carried` lists when someone lifts it and puts it down elsewhere, as [time, x, y, yaw] (s, map frame): its
    wheels and its odometry don't notice. With `stamped` it subscribes to /cmd_vel as
    geometry_msgs/TwistStamped, otherwise as geometry_msgs/Twist.
    """

    radius: Length = 0.1
    mass: Annotated[float, positive("kg")] = 1.0
    wheel_radius: Length = 0.033
    track_width: Length = 0.16
    max_v: Annotated[float, positive("m/s")] = 0.6
    max_w: Annotated[float, positive("rad/s")] = 2.5
    max_acceleration: Annotated[float, positive("m/s^2")] = 2.0
    max_angular_acceleration: Annotated[float, positive("rad/s^2")] = 8.0
    command_timeout: Annotated[float, within(DT, 1000, "seconds")] = 0.5
    max_force: Annotated[float, positive("N")] = 5.0
    max_torque: Annotated[float, positive("N m")] = 0.25
    friction: Annotated[float, within(0, 10)] = 0.3
    stamped: Annotated[bool, Constraint("true or false")] = False
    odometry: Annotated[Pose, Constraint("[x, y, yaw] (meters and radians)")] = (0.0, 0.0, 0.0)  # at time 0
    carried: Annotated[tuple[Carry, ...], Constraint("a list of [time, x, y, yaw] (s, meters, radians)")] = ()

    @property
    def inertia(self) -> float:
        """Moment of inertia about its center, kg m^2."""
        return self.mass * self.radius**2 / 2

    def __post_init__(self) -> None:
        super().__post_init__()
        # A faster robot could pass through a thin wall between two steps.
        if self.max_v * DT > self.radius:
            self.reject(
                "max_v", f"{self.radius / DT:g} m/s or less, one radius in a physics step of {DT:g} s"
            )
        # If the wheels' traction were too weak for ramps and curves, odometry would drift without a
        # collision.
        force = self.mass * math.hypot(self.max_acceleration, self.max_v * self.max_w)
        if self.max_force <= force:
            self.reject("max_force", f"more than {force:g} N, which the robot's ramps and curves need")
        torque = self.inertia * self.max_angular_acceleration
        if self.max_torque <= torque:
            self.reject("max_torque", f"more than {torque:g} N m, which the robot's ramps need")


@dataclass(frozen=True)
class OtherRobot(Model):
    """A further robot like the first, in its own namespace.

    `start` is (x, y, yaw) in the map frame. A robot with a `route`, corners (x, y) in the map frame, follows
    it at `speed` (m/s); one without is driven by commands on /NAME/cmd_vel. `charger` is the position (m) of
    its own charger; without one, it uses the first robot's.
    """

    name: Annotated[str, Constraint(_NAME, re.compile(r"[a-z][a-z0-9]*(_[a-z0-9]+)*").fullmatch)]
    start: Annotated[Pose, Constraint("[x, y, yaw] (meters and radians)")]
    route: Annotated[tuple[Point, ...], Constraint(ROUTE, is_loop)] = ()
    speed: Annotated[float, positive("m/s")] = 0.2
    charger: Annotated[Point, Constraint("[x, y] (meters)")] | None = None


class Odometry(NamedTuple):
    """Wheel odometry: pose in odom (m, rad), velocity in base_link (m/s, rad/s)."""

    x: float
    y: float
    yaw: float
    v: float
    w: float


class WheelJoints(NamedTuple):
    """The two wheel joints: angles (rad, not wrapped) and rates (rad/s), positive when rolling forwards."""

    left: float
    right: float
    left_rate: float
    right_rate: float


def wrap(angle: float) -> float:
    """The same angle (rad) in (-pi, pi]."""
    angle = math.remainder(angle, math.tau)
    return angle if angle > -math.pi else math.pi
