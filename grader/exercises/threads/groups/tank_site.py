"""The site of a robot with a water tank: what its wheels carry, and the curve that is ordered."""

import math
import random
from collections.abc import Callable
from functools import partial

from geometry_msgs.msg import Vector3
from rclpy.node import Node
from std_msgs.msg import Float64

LOAD, RADIUS = "/load", "/radius"
PERIOD = 0.02  # s between two loads
ORDERED = 0.06  # s
TOTAL, SWING, NOISE = 60.0, 9.0, 1.0  # kg
RADII = 1.0, 4.0  # m


class TankSite(Node):
    """Publishes what the wheels carry (Vector3 on /load: x left, y right, in kg) and a radius (Float64, m).

    The water moves all the time, and the sum stays the same. The radius comes at the moment of a load.
    """

    def __init__(self, seed: int = 0) -> None:
        super().__init__("tank_site")
        self.drawn = random.Random(f"tank {seed}")
        self.turn = self.drawn.uniform(0.0, math.tau)
        self.loads = self.create_publisher(Vector3, LOAD, 10)
        self.radius = self.create_publisher(Float64, RADIUS, 10)
        self.count = 0
        self.create_timer(PERIOD, self.tick)

    def tick(self) -> None:
        """Publish the next load, and the radius if it is due."""
        self.count += 1
        swing = SWING * math.sin(self.turn + 4.0 * self.count * PERIOD) + self.drawn.uniform(-NOISE, NOISE)
        left = TOTAL / 2 + swing
        self.loads.publish(Vector3(x=left, y=TOTAL - left))
        if self.count == round(ORDERED / PERIOD):
            self.radius.publish(Float64(data=self.drawn.uniform(*RADII)))


def tank_site(seed: int) -> list[Callable[[], TankSite]]:
    """Return the site of this seed, as companions of a run."""
    return [partial(TankSite, seed)]
