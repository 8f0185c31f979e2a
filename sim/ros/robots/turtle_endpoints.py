"""The topics, services and action of one turtle of turtlesim."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import QoSProfile
from turtlesim.msg import Color, Pose
from turtlesim.srv import SetPen, TeleportAbsolute, TeleportRelative

from sim.ros.messages.template import Template
from sim.ros.robots.turtle_rotation import RotateServer
from sim.world import CommandError
from sim.world.machines import Pen, Pond, Turtle

DEPTH = 7  # of all queues


class TurtleEnds:
    """The endpoints of one turtle, in the namespace of its name.

    Subscribes cmd_vel (geometry_msgs/Twist), publishes pose (turtlesim/Pose) and color_sensor
    (turtlesim/Color). Services: set_pen, teleport_absolute and teleport_relative; the action
    rotate_absolute.
    """

    def __init__(self, node: Node, pond: Pond, turtle: Turtle) -> None:
        self._node, self._pond, self._turtle = node, pond, turtle
        name, qos = turtle.name, QoSProfile(depth=DEPTH)
        self._pose = Template(Pose(), ["x", "y", "theta", "linear_velocity", "angular_velocity"])
        self._color = Template(Color(), ["r", "g", "b"])
        self._pose_pub = node.create_publisher(Pose, f"{name}/pose", qos)
        self._color_pub = node.create_publisher(Color, f"{name}/color_sensor", qos)
        self._commands = node.create_subscription(Twist, f"{name}/cmd_vel", self.on_command, qos)
        self._services = [
            node.create_service(SetPen, f"{name}/set_pen", self.on_set_pen),
            node.create_service(TeleportRelative, f"{name}/teleport_relative", self.on_relative),
            node.create_service(TeleportAbsolute, f"{name}/teleport_absolute", self.on_absolute),
        ]
        self._rotations = RotateServer(node, turtle)

    def publish(self) -> None:
        """Publish the turtle's pose and the color below it, and log what happened to it."""
        turtle, log = self._turtle, self._node.get_logger()
        self._rotations.watch()
        for x, y in turtle.wall_hits:
            log.warning(f"Oh no! I hit the wall! (Clamping from [x={x:f}, y={y:f}])")
        turtle.wall_hits.clear()
        ahead, left, turn = turtle.velocity
        self._pose_pub.publish(self._pose.fill(*turtle.pose, math.hypot(ahead, left), turn))
        self._color_pub.publish(self._color.fill(*turtle.color))

    def close(self) -> None:
        """Destroy the endpoints; the action server remains until no goal is running."""
        node = self._node
        self._rotations.abort_leaving()
        node.destroy_subscription(self._commands)
        for service in self._services:
            node.destroy_service(service)
        for publisher in (self._pose_pub, self._color_pub):
            node.destroy_publisher(publisher)

    def close_if_idle(self) -> bool:
        """Destroy the action server if no goal is running; returns whether it did."""
        return self._rotations.close_if_idle()

    def on_command(self, command: Twist) -> None:
        """Move at this velocity for a second."""
        left = command.linear.y if self._node.get_parameter("holonomic").value else 0.0
        velocity = (command.linear.x, left, command.angular.z)
        if self._apply_command(self._pond.command, self._turtle.name, *velocity):
            self._rotations.abort_replaced("Velocity command received during rotation goal. Aborting goal")

    def on_set_pen(self, request: Any, response: Any) -> Any:
        """Change the pen, or switch it off."""
        if request.off:
            self._turtle.lift_pen()
        else:
            color = request.r, request.g, request.b
            self._turtle.set_pen(Pen(color, request.width or 1))
        return response

    def on_relative(self, request: Any, response: Any) -> Any:
        """Turn, then move forward, instantly."""
        self._apply_command(self._turtle.teleport_by, request.linear, request.angular)
        return response

    def on_absolute(self, request: Any, response: Any) -> Any:
        """Move to another pose, instantly."""
        self._apply_command(self._turtle.teleport_to, request.x, request.y, request.theta)
        return response

    def _apply_command(self, act: Callable[..., None], *values: Any) -> bool:
        try:
            act(*values)
        except CommandError as error:
            self._node.get_logger().error(str(error), throttle_duration_sec=1.0)
            return False
        return True
