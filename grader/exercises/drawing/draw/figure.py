"""A figure that an arm has to draw."""

import cmath
import functools
import math
import random
from collections.abc import Callable

from geometry_msgs.msg import Point32, Polygon
from rclpy.node import Node

from grader.companions.qos import LATCHED
from grader.geometry import Point
from grader.worlds.arms import desk_of, side_of
from sim.world.machines import ArmModel

POINTS = 36
SHAPES: dict[str, Callable[[float], float]] = {
    "circle": lambda angle: 1.0,
    "flower": lambda angle: 1.0 + 0.2 * math.cos(5 * angle),
    "egg": lambda angle: 1.0 + 0.25 * math.sin(angle),
}


def figure(seed: int) -> list[Point]:
    """Return a closed figure beside the arm of `desk_of(seed)`, as points (m) in its base_link.

    That of seed 1 is in front of the arm; the others are long, and end behind the shoulder, where x < 0.
    """
    draw, arm = random.Random(f"figure {seed}"), desk_of(seed).machine
    assert isinstance(arm, ArmModel)
    shape = SHAPES[draw.choice(sorted(SHAPES)) if seed > 2 else "circle"]
    reach = arm.shoulder.length + arm.elbow.length
    near, where = reach * draw.uniform(0.58, 0.64), draw.uniform(0.5, 0.64)
    width = draw.uniform(0.08, 0.11)
    if seed == 1:
        middle, half = cmath.rect(near, where), complex(width)
    else:
        begin = cmath.rect(near, where - 0.1)
        end = cmath.rect(reach * draw.uniform(0.82, 0.86), draw.uniform(1.7, 1.8))
        middle, half = (begin + end) / 2, (begin - end) / 2
    across = 1j * half / abs(half) * width
    angles = [math.tau * index / POINTS for index in range(POINTS + 1)]
    points = [middle + half * math.cos(a) + across * shape(a) * math.sin(a) for a in angles]
    return [(round(point.real, 4), round(side_of(seed) * point.imag, 4)) for point in points]


class Designer(Node):
    """Publishes a figure to be drawn once on /figure (Polygon), latched."""

    def __init__(self, points: list[Point]) -> None:
        super().__init__("designer")
        self.publisher = self.create_publisher(Polygon, "/figure", LATCHED)
        self.publisher.publish(Polygon(points=[Point32(x=x, y=y) for x, y in points]))


def designer(seed: int) -> list[Callable[[], Node]]:
    """Return the designer of a seed, as companions of a run in `desk_of(seed)`."""
    return [functools.partial(Designer, figure(seed))]
