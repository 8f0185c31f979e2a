"""A turtle: it moves as commanded, draws its path, and stays within the pond."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from sim.world.machines.pond_image import PER_METER, SIDE, PondImage, clipped
from sim.world.pen_drawing import Color, PenDrawing, Stroke
from sim.world.robot import CommandError, Pose

STEP = 0.016
"""Time step of a pond, s."""
_TIMEOUT = 1.0  # s after which a velocity command expires
_TOLERANCE = 0.02  # rad; of a rotation's goal
_STOPPED = (0.0, 0.0, 0.0)


def wrap_half_open(angle: float) -> float:
    """The same angle (rad) in [-pi, pi), as turtlesim normalizes it."""
    return angle - math.tau * math.floor((angle + math.pi) / math.tau)


@dataclass
class Pen:
    """A turtle's pen: width in pixels; it draws while `down`."""

    color: Color = (0xB3, 0xB8, 0xFF)
    width: int = 3
    down: bool = True


@dataclass
class Rotation:
    """A rotation to a heading (rad): what remains, and `delta` from the current to the start heading."""

    theta: float
    start: float
    remaining: float = 0.0
    delta: float = 0.0
    done: bool = False


class Turtle:
    """One turtle, at (x, y) in m and theta in rad. Its pen draws into the pond's image and drawing.

    Attributes:
        wall_hits: commanded positions outside the pond (m; the second counts downwards, as in turtlesim)
        since
            the list was last cleared.

    Raises CommandError for a pose with NaN or infinity.
    """

    def __init__(self, name: str, pose: Pose, image: PondImage, drawing: PenDrawing) -> None:
        _check("Places", *pose)
        self.name = name
        self.x, self.y, self.theta = pose
        self.velocity = _STOPPED  # forward, left (m/s), and counter-clockwise (rad/s)
        self.pen = Pen()
        self.wall_hits: list[tuple[float, float]] = []
        self.color: Color = drawing.ground  # of the ground beneath it
        self._image, self._drawing = image, drawing
        self._commanded_at = 0.0  # time of the latest velocity command, s
        self._teleports: list[tuple[bool, float, float, float]] = []
        self._rotation: Rotation | None = None
        self._stroke: Stroke | None = None

    @property
    def pose(self) -> Pose:
        """x, y (m) and theta (rad)."""
        return self.x, self.y, self.theta

    def command(self, ahead: float, left: float, turn: float, now: float) -> None:
        """Set the velocity (m/s, m/s, rad/s) for a second from `now` (s) on; aborts a rotation.

        Raises CommandError for NaN or infinity.
        """
        _check("Velocity commands", ahead, left, turn)
        self._rotation = None
        self.velocity, self._commanded_at = (ahead, left, turn), now

    def teleport_to(self, x: float, y: float, theta: float) -> None:
        """Teleport to a pose at the next step. Raises CommandError for NaN or infinity."""
        _check("Places", x, y, theta)
        self._teleports.append((False, x, y, theta))

    def teleport_by(self, linear: float, angular: float) -> None:
        """Turn (rad), then move forward (m), at the next step. Raises CommandError for NaN or infinity."""
        _check("Places", linear, angular)
        self._teleports.append((True, linear, 0.0, angular))

    def rotate(self, theta: float) -> Rotation:
        """Rotate to a heading (rad) at 1 rad/s. Raises CommandError for NaN or infinity."""
        _check("Headings", theta)
        self._rotation = Rotation(wrap_half_open(theta), self.theta)
        return self._rotation

    def stop(self) -> None:
        """Set the velocity to 0; aborts a rotation."""
        self._rotation, self.velocity = None, _STOPPED

    def set_pen(self, pen: Pen) -> None:
        """Draw with another pen from now on."""
        self.pen, self._stroke = pen, None

    def lift_pen(self) -> None:
        """Stop drawing until another pen is set."""
        self.pen.down, self._stroke = False, None

    def break_stroke(self) -> None:
        """Start a new stroke with the next line, because the previous ones were erased."""
        self._stroke = None

    def step(self, now: float) -> None:
        """Advance by one step, to `now` (s)."""
        for teleport in self._teleports:
            self._apply(teleport, now)
        self._teleports.clear()
        self._turn(now)
        if now - self._commanded_at > _TIMEOUT:
            self.velocity = _STOPPED
        begin = self.x, self.y
        ahead, left, turn = self.velocity
        self.theta = wrap_half_open(self.theta + turn * STEP)
        cos, sin = math.cos(self.theta), math.sin(self.theta)
        x, y = self.x + (cos * ahead - sin * left) * STEP, self.y + (sin * ahead + cos * left) * STEP
        if not (0 <= x <= SIDE and 0 <= y <= SIDE):
            self.wall_hits.append((x, SIDE - y))
        self.x, self.y = min(max(x, 0.0), SIDE), min(max(y, 0.0), SIDE)
        # The color sensor reads the ground before the new segment of the line is drawn.
        self.color = self._image.color(self.x, self.y, self._drawing.ground)
        if begin != (self.x, self.y):
            self._draw(*begin, self.x, self.y, now)

    def _apply(self, teleport: tuple[bool, float, float, float], now: float) -> None:
        begin = self.x, self.y
        relative, x, y, theta = teleport
        if relative:
            self.theta += theta
            self.x += math.cos(self.theta) * x
            self.y += math.sin(self.theta) * x
        else:
            self.x, self.y, self.theta = x, min(y, SIDE), theta
        self._draw(*begin, self.x, self.y, now)

    def _turn(self, now: float) -> None:
        """Continue the rotation, if there is one."""
        rotation = self._rotation
        if rotation is None:
            return
        rotation.delta = wrap_half_open(rotation.start - self.theta)
        rotation.remaining = wrap_half_open(rotation.theta - self.theta)
        if abs(rotation.remaining) < _TOLERANCE:
            rotation.done = True
            self.stop()
        else:
            self.velocity, self._commanded_at = (0.0, 0.0, math.copysign(1.0, rotation.remaining)), now

    def _draw(self, x0: float, y0: float, x1: float, y1: float, now: float) -> None:
        part = clipped(x0, y0, x1, y1) if self.pen.down else None
        if part is None:
            self._stroke = None
            return
        self._image.line(*part, self.pen.color, self.pen.width)
        stroke = self._stroke
        if stroke is None or stroke.points[-1][1:] != part[:2]:
            stroke = self._stroke = Stroke(self.name, self.pen.color, self.pen.width / PER_METER)
            stroke.points.append((now, *part[:2]))
            self._drawing.strokes.append(stroke)
        stroke.points.append((now, *part[2:]))


def as_float32(value: float) -> float:
    """A number rounded to float32, as in messages."""
    return float(np.float32(value))


def _check(what: str, *values: float) -> None:
    if not all(map(math.isfinite, values)):
        shown = ", ".join(f"{value:g}" for value in values)
        raise CommandError(f"{what} are finite numbers; this one was {shown}: check how it was calculated.")
