"""A place in a warehouse for the exercise `perceive`, and what can truly be seen from there."""

from __future__ import annotations

import functools
import math
import random
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from geometry_msgs.msg import Twist
from rclpy.node import Node

from grader.exercises.delivery.floor import Point
from sim.evidence import Pose, Recording, Seconds
from sim.world import LidarModel, World
from sim.world.clearance import clearance
from sim.world.route import Route

FAR, CLOSE = 3.0, 0.7  # m; what is judged is nearer than the one, and boxes farther than the other
COMES = 7.5, 11.0  # s; when somebody comes into view
MEETS = 15.5  # s; by then this person has come to the robot
TURN = 0.3, 0.6  # rad/s
SETTLED = 6.0  # s until what stands is known to stand


@functools.lru_cache(maxsize=16)
def crossing(seed: int) -> World:
    """A warehouse with the robot where somebody will walk, a box in view, and the lidar off its middle."""
    draw = random.Random(f"crossing {seed}")
    side, turn = draw.choice((-1.0, 1.0)), draw.uniform(0.5, math.pi)
    lidar = LidarModel(x=0.07, y=0.04 * side, yaw=round(side * turn, 2))
    for attempt in range(400):
        world = World.generate("warehouse", seed=(seed + attempt * 7919) % 2**32, movable=6)
        person = world.people[0]
        route = Route(person.route)
        place = person.speed * draw.uniform(9.0, MEETS)
        x, y = (round(value, 2) for value in route.point(place))
        if place < route.length - 2.0 and _is_good(world, (x, y), route):
            start = (x, y, round(draw.uniform(-3.0, 3.0), 2))
            return replace(world, name=f"warehouse_{seed}", start=start, lidar=lidar)
    raise ValueError(f"seed {seed}: no warehouse has such a place")


def _is_good(world: World, here: Point, route: Route) -> bool:
    """Whether a box is in view from here, and somebody comes into view in time."""
    boxes = [(box.x, box.y) for box in world.movable]
    if not any(math.dist(here, box) > CLOSE and in_view(world, here, box, FAR - 0.5) for box in boxes):
        return False
    speed = world.people[0].speed
    times = np.arange(0.0, COMES[1], 0.25)
    seen = [when for when in times if in_view(world, here, route.point(speed * when), FAR + 1.0, 0.0)]
    return bool(seen) and seen[0] > COMES[0]


def in_view(world: World, here: Point, there: Point, reach: float, gap: float = 0.25) -> bool:
    """Whether a place is at most `reach` (m) away, and nothing of the map within `gap` (m) of that line."""
    if math.dist(here, there) > reach:
        return False
    x, y = (np.linspace(a, b, 40) for a, b in zip(here, there, strict=True))
    return bool((clearance(world, x, y)[:-4] > gap).all())


def at(track: list[Pose], stamp: Seconds) -> Pose:
    """Where something was then."""
    return min(track, key=lambda pose: abs(pose.stamp - stamp))


def speed_at(track: list[Pose], stamp: Seconds, lasting: Seconds) -> float:
    """How fast something was on average in the time until then, m/s."""
    before, now = at(track, stamp - lasting), at(track, stamp)
    return math.dist(before[1:3], now[1:3]) / lasting


def person_of(run: Recording) -> list[Pose]:
    """The way of the person."""
    return run.tracks["person_1"]


def boxes_of(run: Recording) -> list[Point]:
    """Where boxes stand."""
    return [(track[0].x, track[0].y) for name, track in run.tracks.items() if name.startswith("box")]


class Turner(Node):
    """Turns the robot on the spot."""

    def __init__(self, seed: int) -> None:
        super().__init__("turner")
        draw = random.Random(f"turner {seed}")
        self.command = Twist()
        self.command.angular.z = draw.choice((-1.0, 1.0)) * draw.uniform(*TURN)
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, lambda: self.publisher.publish(self.command))


def turner(seed: int) -> list[Callable[[], Node]]:
    """Who turns the robot, as companions of a run."""
    return [functools.partial(Turner, seed)]
