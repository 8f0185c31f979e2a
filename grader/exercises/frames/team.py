"""Robots on a map, whose cameras see things, and tell of them a little later."""

from __future__ import annotations

import math
import random

from geometry_msgs.msg import PointStamped
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster

from grader.exercises.frames.partners import Flat, transform
from sim.evidence import since_start

BEGIN, PAUSE = 2.0, 0.5  # s; the first sighting, and from one to the next
CAMERAS: dict[str, Flat] = {"robot1": (0.2, 0.0, 0.5), "robot2": (-0.1, 0.1, -1.2), "island": (0.0, 0.0, 0.0)}
# How old each sighting is (s), and who has seen it. "ghost" is in no tree, "island" in another one. The run's
# seed decides on their order, and by which names all of them are called.
SIGHTINGS = (
    (0.6, "robot1"),
    (1.2, "robot2"),
    (0.5, "ghost"),
    (0.9, "robot2"),
    (60.0, "robot1"),  # before anybody said where the robots were: an ExtrapolationException
    (0.7, "island"),
)
NAMES = [f"robot{number}" for number in range(1, 10)]


class Team(Node):
    """Robots that drive round (/tf), their cameras (/tf_static), and what these have seen (/sighting)."""

    def __init__(self) -> None:
        super().__init__("team")
        self.moving, self.static = TransformBroadcaster(self), StaticTransformBroadcaster(self)
        self.publisher = self.create_publisher(PointStamped, "/sighting", 10)
        self.phase = random.uniform(-3.0, 3.0)
        self.count, self.plan = 0, random.sample(SIGHTINGS, len(SIGHTINGS))
        self.called = dict(zip((*CAMERAS, "ghost"), random.sample(NAMES, len(CAMERAS) + 1), strict=True))
        cameras = [
            (f"{self.called[name]}/base_link", f"{self.called[name]}/camera", camera)
            for name, camera in CAMERAS.items()
        ]
        self.static.sendTransform([transform(*one) for one in cameras])
        self.create_timer(0.05, self.move)
        self.begin = self.create_timer(BEGIN, self.start)

    def start(self) -> None:
        """Begin to tell of what was seen."""
        self.begin.cancel()
        self.create_timer(PAUSE, self.see)

    def move(self) -> None:
        """Tell where all robots are."""
        now = self.get_clock().now()
        self.moving.sendTransform(
            [
                transform(
                    "map" if name != "island" else "sea",
                    f"{self.called[name]}/base_link",
                    self.where(name, now),
                    now,
                )
                for name in CAMERAS
            ]
        )

    def where(self, name: str, now: Time) -> Flat:
        """Each on a circle of its own."""
        angle = self.phase + 0.8 * since_start(now.to_msg()) + len(name) + 2.0 * (name == "robot2")
        return 3.0 * math.cos(angle), 2.0 * math.sin(angle), math.remainder(angle + 1.5, math.tau)

    def see(self) -> None:
        """Tell of the next thing: a point in the frame of a camera, and when it was there."""
        age, name = self.plan[self.count % len(SIGHTINGS)]
        self.count += 1
        point = PointStamped()
        point.header.stamp = (self.get_clock().now() - Duration(seconds=age)).to_msg()
        point.header.frame_id = f"{self.called[name]}/camera"
        point.point.x, point.point.y = random.uniform(0.5, 2.0), random.uniform(-1.0, 1.0)
        self.publisher.publish(point)
