"""A turtle in its pond: it moves as it is told, draws where it goes, and can't leave."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from sim.world.drawing import Colour, Drawing, Stroke
from sim.world.machines.canvas import PER_METRE, SIDE, Canvas, clipped
from sim.world.robot import CommandError, Pose

STEP = 0.016
"""s, between two steps of a pond."""
_TIMEOUT = 1.0  # s, that a velocity holds
_NEAR = 0.02  # rad; so near a heading it has been reached
_STILL = (0.0, 0.0, 0.0)


def normal(angle: float) -> float:
    """An angle (rad) from -pi on and below pi."""
    return angle - math.tau * math.floor((angle + math.pi) / math.tau)


@dataclass
class Pen:
    """What a turtle draws with: width in pixels; `down` or lifted."""

    colour: Colour = (0xB3, 0xB8, 0xFF)
    width: int = 3
    down: bool = True


@dataclass
class Rotation:
    """A turn to a heading, under way or done (rad): what remains, and from here back to where it began."""

    theta: float
    start: float
    remaining: float = 0.0
    delta: float = 0.0
    done: bool = False


class Turtle:
    """One turtle, at (x, y) in m and theta in rad. What it draws goes to the pond's canvas and drawing.

    Attributes:
        hits: where it wanted to be outside the pond (m; the second counts downwards, as upstream's) since
            somebody emptied this.

    Raises CommandError for a pose that is not a number.
    """

    def __init__(self, name: str, pose: Pose, canvas: Canvas, drawing: Drawing) -> None:
        _check("Places", *pose)
        self.name = name
        self.x, self.y, self.theta = pose
        self.velocity = _STILL  # ahead, to the left (m/s), and counter-clockwise (rad/s)
        self.pen = Pen()
        self.hits: list[tuple[float, float]] = []
        self.colour: Colour = drawing.ground  # beneath it
        self._canvas, self._drawing = canvas, drawing
        self._told = 0.0  # when it was told how to move, s
        self._jumps: list[tuple[bool, float, float, float]] = []
        self._rotation: Rotation | None = None
        self._stroke: Stroke | None = None

    @property
    def pose(self) -> Pose:
        """x, y (m) and theta (rad)."""
        return self.x, self.y, self.theta

    def command(self, ahead: float, left: float, turn: float, now: float) -> None:
        """Move like this (m/s, m/s, rad/s) for a second from `now` (s) on; a rotation ends.

        Raises CommandError for what is not a number.
        """
        _check("Velocity commands", ahead, left, turn)
        self._rotation = None
        self.velocity, self._told = (ahead, left, turn), now

    def jump_to(self, x: float, y: float, theta: float) -> None:
        """Be there at the next step. Raises CommandError for what is not a number."""
        _check("Places", x, y, theta)
        self._jumps.append((False, x, y, theta))

    def jump(self, linear: float, angular: float) -> None:
        """Turn (rad), then be so far ahead (m), at the next step. Raises CommandError for no numbers."""
        _check("Places", linear, angular)
        self._jumps.append((True, linear, 0.0, angular))

    def rotate(self, theta: float) -> Rotation:
        """Turn to a heading (rad) at 1 rad/s. Raises CommandError for what is not a number."""
        _check("Headings", theta)
        self._rotation = Rotation(normal(theta), self.theta)
        return self._rotation

    def stop(self) -> None:
        """Stand still; a rotation ends."""
        self._rotation, self.velocity = None, _STILL

    def take(self, pen: Pen) -> None:
        """Draw with another pen from now on."""
        self.pen, self._stroke = pen, None

    def lift(self) -> None:
        """Draw no more, until there is another pen."""
        self.pen.down, self._stroke = False, None

    def begin_anew(self) -> None:
        """What was drawn is gone: the next line is a new one."""
        self._stroke = None

    def step(self, now: float) -> None:
        """Move on to `now` (s), by one step."""
        for jump in self._jumps:
            self._do(jump, now)
        self._jumps.clear()
        self._turn(now)
        if now - self._told > _TIMEOUT:
            self.velocity = _STILL
        begin = self.x, self.y
        ahead, left, turn = self.velocity
        self.theta = normal(self.theta + turn * STEP)
        cos, sin = math.cos(self.theta), math.sin(self.theta)
        x, y = self.x + (cos * ahead - sin * left) * STEP, self.y + (sin * ahead + cos * left) * STEP
        if not (0 <= x <= SIDE and 0 <= y <= SIDE):
            self.hits.append((x, SIDE - y))
        self.x, self.y = min(max(x, 0.0), SIDE), min(max(y, 0.0), SIDE)
        # What lies beneath is looked at before the new piece of the line is drawn.
        self.colour = self._canvas.colour(self.x, self.y, self._drawing.ground)
        if begin != (self.x, self.y):
            self._draw(*begin, self.x, self.y, now)

    def _do(self, jump: tuple[bool, float, float, float], now: float) -> None:
        begin = self.x, self.y
        ahead, x, y, theta = jump
        if ahead:
            self.theta += theta
            self.x += math.cos(self.theta) * x
            self.y += math.sin(self.theta) * x
        else:
            self.x, self.y, self.theta = x, min(y, SIDE), theta
        self._draw(*begin, self.x, self.y, now)

    def _turn(self, now: float) -> None:
        """Turn on towards the heading that is wanted, if one is."""
        rotation = self._rotation
        if rotation is None:
            return
        rotation.delta = normal(rotation.start - self.theta)
        rotation.remaining = normal(rotation.theta - self.theta)
        if abs(rotation.remaining) < _NEAR:
            rotation.done = True
            self.stop()
        else:
            self.velocity, self._told = (0.0, 0.0, math.copysign(1.0, rotation.remaining)), now

    def _draw(self, x0: float, y0: float, x1: float, y1: float, now: float) -> None:
        part = clipped(x0, y0, x1, y1) if self.pen.down else None
        if part is None:
            self._stroke = None
            return
        self._canvas.line(*part, self.pen.colour, self.pen.width)
        stroke = self._stroke
        if stroke is None or stroke.points[-1][1:] != part[:2]:
            stroke = self._stroke = Stroke(self.name, self.pen.colour, self.pen.width / PER_METRE)
            stroke.points.append((now, *part[:2]))
            self._drawing.strokes.append(stroke)
        stroke.points.append((now, *part[2:]))


def single(value: float) -> float:
    """A number as float32 keeps it: what messages carry."""
    return float(np.float32(value))


def _check(what: str, *values: float) -> None:
    if not all(map(math.isfinite, values)):
        shown = ", ".join(f"{value:g}" for value in values)
        raise CommandError(f"{what} are finite numbers; this one was {shown}: check how it was worked out.")
