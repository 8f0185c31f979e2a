"""What Nav2's bringup starts beside a navigator: a map server and a localization; and clicks on the map.

These programs know the world, so each class is made for one: `bringup(world)`.
"""

import array
import math
import random
from typing import Any, ClassVar

import numpy as np
from geometry_msgs.msg import PointStamped
from nav_msgs.msg import OccupancyGrid
from rclpy.node import Node
from tf2_msgs.msg import TFMessage

from grader.companions.qos import LATCHED
from grader.companions.transforms import transform
from grader.geometry import Pose2D
from grader.geometry.ground import RESOLUTION, ground
from sim.evidence import Seconds, since_start
from sim.nanoseconds import SECOND
from sim.ros.messages.template import STAMP, Template
from sim.world import World

AHEAD, PERIOD = SECOND // 10, 0.05  # ns, s


def made_for(node: type[Node], **attributes: Any) -> type[Node]:
    """Return a subclass of a node, of the same name, with attributes of its own."""
    return type(node.__name__, (node,), attributes | {"__module__": node.__module__})


def bringup(world: World | str, known: World | None = None, late: Seconds = 0.0) -> list[type[Node]]:
    """Return the map server and the localization for a world, to run beside a navigator.

    known: the world as the map shows it, where something in the real one is in no map. late: as in
    Localization.
    """
    world = World.load(world) if isinstance(world, str) else world
    map_server = made_for(MapServer, world=known or world)
    return [map_server, made_for(Localization, start=world.start, late=late)]


class MapServer(Node):
    """Publishes the map once, latched, on /map, as Nav2's map server does.

    A cell is 0 (free), 100 (occupied) or -1 (unknown).
    """

    world: ClassVar[World]
    node_name, topic = "map_server", "/map"

    def __init__(self) -> None:
        super().__init__(self.node_name)
        floor, message = ground(self.world), OccupancyGrid()
        message.header.frame_id, info = "map", message.info
        info.resolution, info.width, info.height = RESOLUTION, floor.columns, floor.rows
        info.origin.position.x, info.origin.position.y = floor.origin
        cells = np.where(floor.known, np.where(self.occupied(), 100, 0), -1)
        message.data = array.array("b", cells.astype(np.int8).tobytes())
        self.publisher = self.create_publisher(OccupancyGrid, self.topic, LATCHED)
        self.publisher.publish(message)

    def occupied(self) -> np.ndarray:
        """Return which cells are occupied."""
        return ground(self.world).occupied


class CostmapServer(MapServer):
    """Publishes the map inflated by the robot's size, latched, on /global_costmap/costmap."""

    node_name, topic = "costmap", "/global_costmap/costmap"
    radius = 0.15  # meters

    def occupied(self) -> np.ndarray:
        """Return which cells the robot must not enter."""
        return ground(self.world).clearance <= self.radius


class Localization(Node):
    """Publishes the transform from map to odom on /tf, 20 times a second.

    As AMCL does, it stamps this a little ahead, so that the pose of a measurement of just now can be looked
    up. It trusts the odometry and knows where the robot started, so the transform is always the same. AMCL
    compares the lidar with the map and corrects the transform all the time.

    late: how long after its start it publishes the first one (s); AMCL first needs a scan and a map.
    ends: from when to when it publishes the last one (s); without it, never.
    """

    start: ClassVar[tuple[float, float, float]]
    late: ClassVar[Seconds] = 0.0
    ends: ClassVar[tuple[Seconds, Seconds] | None] = None

    def __init__(self) -> None:
        super().__init__("localization")
        self.last = random.uniform(*self.ends) if self.ends else math.inf
        self.publisher = self.create_publisher(TFMessage, "/tf", 10)
        message = TFMessage(transforms=[transform("map", "odom", Pose2D(*self.start))])
        self.message = Template(message, [f"transforms.0.{field}" for field in STAMP])
        self.skipped = round(self.late / PERIOD)  # calls of the timer
        self.create_timer(PERIOD, self.publish)

    def publish(self) -> None:
        """Publish the transform from map to odom, if it is time."""
        if self.skipped:
            self.skipped -= 1
            return
        now = self.get_clock().now()
        if since_start(now.to_msg()) < self.last:
            self.publisher.publish(self.message.fill(*divmod(now.nanoseconds + AHEAD, SECOND)))


class PointClicker(Node):
    """Clicks on the map twice a second, as RViz' tool Publish Point does: PointStamped on /clicked_point."""

    world: ClassVar[World]

    def __init__(self) -> None:
        super().__init__("point_clicker")
        self.publisher = self.create_publisher(PointStamped, "/clicked_point", 10)
        self.create_timer(0.5, self.click)

    def click(self) -> None:
        """Click somewhere inside the world."""
        left, bottom, right, top = self.world.bounds
        msg = PointStamped()
        msg.header.frame_id, msg.header.stamp = "map", self.get_clock().now().to_msg()
        msg.point.x, msg.point.y = random.uniform(left, right), random.uniform(bottom, top)
        self.publisher.publish(msg)
