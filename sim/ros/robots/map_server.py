"""Publishes a warehouse's map, the robots' odometry frames in it, and the poses of their chargers."""

from __future__ import annotations

import math

import numpy as np
from geometry_msgs.msg import PoseStamped, TransformStamped
from nav_msgs.msg import OccupancyGrid
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from tf2_msgs.msg import TFMessage

from sim.world import World
from sim.world.clearance import clearance

RESOLUTION = 0.05  # m; a cell's width
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
OCCUPIED = 100


class WarehouseMapServer(Node):
    """Publishes once, latched: /map, /tf_static (map -> odom) and /dock_pose.

    Each further robot has a dock_pose in its namespace. The map shows static objects. The transforms hold as
    long as wheels don't slip, because no node corrects them.
    """

    def __init__(self, world: World) -> None:
        super().__init__("map_server", start_parameter_services=False)
        self.now = self.get_clock().now().to_msg()
        self.map_pub = self.create_publisher(OccupancyGrid, "/map", LATCHED)
        self.map_pub.publish(self.grid(world))
        self.static_pub = self.create_publisher(TFMessage, "/tf_static", LATCHED)
        self.static_pub.publish(TFMessage(transforms=[*map(self.odometry, world.starts().items())]))
        for robot, charger in world.chargers.items():
            topic = "/dock_pose" if robot == "robot" else f"/{robot}/dock_pose"
            self.create_publisher(PoseStamped, topic, LATCHED).publish(self.dock(*charger))

    def grid(self, world: World) -> OccupancyGrid:
        """The map: a cell is occupied if a solid object reaches into it."""
        left, bottom, right, top = world.bounds
        columns, rows = (math.ceil(size / RESOLUTION) + 4 for size in (right - left, top - bottom))
        message = OccupancyGrid()
        message.header.stamp, message.header.frame_id = self.now, "map"
        info = message.info
        info.map_load_time, info.resolution, info.width, info.height = self.now, RESOLUTION, columns, rows
        x0, y0 = left - 2 * RESOLUTION, bottom - 2 * RESOLUTION
        info.origin.position.x, info.origin.position.y, info.origin.orientation.w = x0, y0, 1.0
        x, y = np.meshgrid(
            x0 + (np.arange(columns) + 0.5) * RESOLUTION, y0 + (np.arange(rows) + 0.5) * RESOLUTION
        )
        solid = clearance(world, x, y) < RESOLUTION * math.sqrt(0.5)
        message.data = np.where(solid, OCCUPIED, 0).astype(np.int8).ravel().tolist()
        return message

    def odometry(self, start: tuple[str, tuple[float, float, float]]) -> TransformStamped:
        """The transform of a robot's odometry frame: its start pose."""
        name, (x, y, yaw) = start
        transform = TransformStamped(child_frame_id="odom" if name == "robot" else f"{name}/odom")
        transform.header.stamp, transform.header.frame_id = self.now, "map"
        move = transform.transform
        move.translation.x, move.translation.y = x, y
        move.rotation.z, move.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        return transform

    def dock(self, x: float, y: float) -> PoseStamped:
        """The pose of a charger."""
        message = PoseStamped()
        message.header.stamp, message.header.frame_id = self.now, "map"
        message.pose.position.x, message.pose.position.y, message.pose.orientation.w = x, y, 1.0
        return message
