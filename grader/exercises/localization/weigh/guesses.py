"""A room with things that aren't on its map, and guesses about where the robot in it is."""

import functools
import math
import random
from collections.abc import Iterator
from dataclasses import replace
from typing import ClassVar

import numpy as np
from geometry_msgs.msg import PoseArray
from rclpy.node import Node

from grader.companions.map_messages import posed
from grader.companions.maps import MapServer, made_for
from grader.geometry.ground import ground
from sim.world import Box, Circle, LidarModel, World

Guess = tuple[float, float, float]  # x, y (m) and yaw (rad) of base_link in the map

CLUSTER, CLUSTERS, LONELY = 20, 3, 80  # guesses in a cluster; clusters at random, and guesses besides
CLOSE, TURNED = 0.03, 0.035  # m, rad: how far a cluster reaches to each side
APART, ASKEW = 0.35, 0.5  # m, rad: guesses that are farther off than one of these are wrong
ROOM = 0.15  # m that are free around a guess
SILENT = 0.25  # m: the lidar measures nothing nearer
POST, CRATE = 0.05, 0.3  # m: the radius of a post, the width of a crate
ASIDE = -4.2, 1.7  # m: where the room's corner is on the map


@functools.lru_cache(maxsize=64)
def visited(seed: int) -> tuple[World, World]:
    """Return a room, and the same room as its map shows it: without a crate and a post beside the robot.

    The lidar is mounted beside the robot's center and turned, loses rays, and is too near to the post.
    """
    draw = random.Random(f"visited {seed}")
    known = _shifted(World.generate("room", seed=seed, width=6.5, height=4.5, boxes=3, circles=2))
    side = draw.choice((-1.0, 1.0))
    lidar = LidarModel(
        rays=360, noise=0.02, dropouts=0.1, range_min=SILENT, range_max=4.0,
        x=round(draw.choice((-1.0, 1.0)) * draw.uniform(0.03, 0.06), 2), y=round(-side * 0.05, 2),
        yaw=round(draw.choice((-1.0, 1.0)) * draw.uniform(1.0, 2.6), 2),
    )
    post = Circle(*_beside(known.start, side * 1.2, 0.21), POST)
    crate = Box(*_beside(known.start, -side * draw.uniform(0.3, 1.0), 0.75), known.start[2], CRATE, CRATE)
    known = replace(known, name=f"visited_{seed}")
    return replace(known, boxes=(*known.boxes, crate), circles=(*known.circles, post), lidar=lidar), known


def _shifted(world: World) -> World:
    """Return the world elsewhere on the map: rows taken for columns are wrong then, as they are in life."""
    dx, dy = ASIDE
    boxes = tuple(replace(box, x=box.x + dx, y=box.y + dy) for box in world.boxes)
    circles = tuple(replace(circle, x=circle.x + dx, y=circle.y + dy) for circle in world.circles)
    walls = tuple(((a + dx, b + dy), (c + dx, d + dy)) for (a, b), (c, d) in world.walls)
    left, bottom, right, top = world.bounds
    bounds = left + dx, bottom + dy, right + dx, top + dy
    start = round(world.start[0] + dx, 2), round(world.start[1] + dy, 2), world.start[2]
    known = replace(world, walls=walls, boxes=boxes, circles=circles)
    return replace(known, bounds=bounds, start=start, goal=None)


def _beside(start: Guess, angle: float, distance: float) -> tuple[float, float]:
    """The point at an angle (rad, to the left) and a distance (m) from a pose."""
    x, y, yaw = start
    return x + distance * math.cos(yaw + angle), y + distance * math.sin(yaw + angle)


def is_close(guess: Guess, truth: Guess) -> bool:
    """Return whether a guess is in the cluster around a pose."""
    turn = abs(math.remainder(guess[2] - truth[2], math.tau))
    return math.dist(guess[:2], truth[:2]) < 2 * CLOSE and turn < 2 * TURNED


class GuessPublisher(Node):
    """Publishes 200 guesses about where the robot is every two seconds: PoseArray on /candidates.

    Some are in clusters: around the robot, around where it would be if its lidar were in its middle, a little
    aside, and at random. The others are anywhere.
    """

    world: ClassVar[World]

    def __init__(self) -> None:
        super().__init__("guess_publisher")
        self.publisher = self.create_publisher(PoseArray, "/candidates", 10)
        self.create_timer(2.0, self.publish)

    def publish(self) -> None:
        """Draw guesses, and publish them in any order."""
        guesses = [guess for middle in self.middles() for guess in _cluster(middle)]
        guesses += [self.anywhere() for _ in range(LONELY)]
        random.shuffle(guesses)
        message = PoseArray(poses=[posed(*guess) for guess in guesses])
        message.header.frame_id, message.header.stamp = "map", self.get_clock().now().to_msg()
        self.publisher.publish(message)

    def middles(self) -> Iterator[Guess]:
        """Yield the middles of the clusters."""
        truth, direction = self.world.start, random.uniform(-math.pi, math.pi)
        yield truth
        yield self.world.lidar.mounted_at(truth)
        yield (truth[0] + APART * math.cos(direction), truth[1] + APART * math.sin(direction), truth[2])
        for _ in range(CLUSTERS):
            yield self.anywhere()

    def anywhere(self) -> Guess:
        """A guess in the free part of the map that is wrong."""
        floor, (x, y, yaw) = ground(self.world), self.world.start
        rows, columns = np.nonzero(floor.free(ROOM))
        while True:
            cell = random.randrange(len(rows))
            place = float(floor.x[rows[cell], columns[cell]]), float(floor.y[rows[cell], columns[cell]])
            turn = random.uniform(-math.pi, math.pi)
            if not (math.dist(place, (x, y)) <= APART and abs(math.remainder(turn - yaw, math.tau)) <= ASKEW):
                return (*place, turn)


def _cluster(middle: Guess) -> list[Guess]:
    """Guesses around a pose."""
    x, y, yaw = middle
    offsets = [[random.uniform(-1.0, 1.0) for _ in range(3)] for _ in range(CLUSTER)]
    return [(x + CLOSE * dx, y + CLOSE * dy, yaw + TURNED * turn) for dx, dy, turn in offsets]


def guessing(seed: int) -> list[type[Node]]:
    """Return the map server and the guesses for a room, as companions of a run."""
    real, known = visited(seed)
    return [made_for(MapServer, world=known), made_for(GuessPublisher, world=real)]
