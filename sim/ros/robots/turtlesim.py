"""turtlesim as an ordinary ROS 2 node, with upstream's names, types, log lines and behavior."""

from __future__ import annotations

from typing import Any

from rcl_interfaces.msg import IntegerRange, ParameterDescriptor
from rclpy.exceptions import InvalidTopicNameException
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.validate_topic_name import validate_topic_name
from std_srvs.srv import Empty
from turtlesim.srv import Kill, Spawn

from sim.ros.robots.turtle_endpoints import TurtleEnds
from sim.world import CommandError
from sim.world.machines import Pond, Turtle

CHANNELS = {"background_r": "Red", "background_g": "Green", "background_b": "Blue"}
PERIOD = 0.016  # s


class Turtlesim(Node):
    """The node of a pond with any number of turtles.

    Services: spawn, kill (turtlesim/srv), clear and reset (std_srvs/Empty). Parameters: background_r,
    background_g and background_b (0 to 255), and holonomic. Each turtle has a `TurtleEnds`.

    It differs from upstream in three ways: color_sensor shows the background where no line was drawn, and
    invalid names and non-finite numbers are refused with a log line.
    """

    def __init__(self, scene: Pond) -> None:
        super().__init__("turtlesim")
        self.scene = scene
        self._declare()
        self._turtles: dict[str, TurtleEnds] = {}
        self._closing: list[TurtleEnds] = []
        self.create_service(Empty, "clear", self.on_clear)
        self.create_service(Empty, "reset", self.on_reset)
        self.create_service(Spawn, "spawn", self.on_spawn)
        self.create_service(Kill, "kill", self.on_kill)
        self.get_logger().info(f"Starting turtlesim with node name {self.get_fully_qualified_name()}")
        self._add_all()
        self.create_timer(PERIOD, self.tick)

    def _declare(self) -> None:
        channel = IntegerRange(from_value=0, to_value=255, step=1)
        for (name, color), value in zip(CHANNELS.items(), self.scene.drawing.ground, strict=True):
            description = f"{color} channel of the background color"
            self.declare_parameter(
                name, value, ParameterDescriptor(description=description, integer_range=[channel])
            )
        self.declare_parameter(
            "holonomic", False, ParameterDescriptor(description="If true, then turtles will be holonomic")
        )
        self._paint()  # parameters may have been set at the start
        self.add_post_set_parameters_callback(self._paint)

    def _paint(self, _: list[Parameter] | None = None) -> None:
        self.scene.set_background(tuple(self.get_parameter(name).value for name in CHANNELS))

    def tick(self) -> None:
        """Publish the state of all turtles."""
        for name in sorted(self._turtles):
            self._turtles[name].publish()
        self._closing = [ends for ends in self._closing if not ends.close_if_idle()]

    def on_clear(self, request: Any, response: Any) -> Any:
        """Erase all lines."""
        self.get_logger().info("Clearing turtlesim.")
        self.scene.clear()
        return response

    def on_reset(self, request: Any, response: Any) -> Any:
        """Start again with one turtle."""
        self.get_logger().info("Resetting turtlesim.")
        for name in list(self._turtles):
            self._remove(name)
        self.scene.reset()
        self._add_all()
        return response

    def on_spawn(self, request: Any, response: Any) -> Any:
        """Add a turtle; the response has its name, which is empty if that failed."""
        name = request.name or self.scene.unused_name()
        if name in self.scene.turtles:
            self.get_logger().error(f"A turtle named [{name}] already exists")
            return response
        try:
            validate_topic_name(f"{name}/pose")
            turtle = self.scene.spawn(name, request.x, request.y, request.theta)
        except InvalidTopicNameException:
            self.get_logger().error(
                f"A turtle can't be named [{name}]: write letters, digits and _, and begin with a letter"
            )
        except CommandError as error:
            self.get_logger().error(str(error))
        else:
            self._add(turtle)
            response.name = name
        return response

    def on_kill(self, request: Any, response: Any) -> Any:
        """Remove a turtle."""
        if request.name in self.scene.turtles:
            self._remove(request.name)
            self.scene.kill(request.name)
        else:
            self.get_logger().error(f"Tried to kill turtle [{request.name}], which does not exist")
        return response

    def _add_all(self) -> None:
        for turtle in self.scene.turtles.values():
            self._add(turtle)

    def _add(self, turtle: Turtle) -> None:
        self._turtles[turtle.name] = TurtleEnds(self, self.scene, turtle)
        self.get_logger().info(
            f"Spawning turtle [{turtle.name}] at x=[{turtle.x:f}], y=[{turtle.y:f}], theta=[{turtle.theta:f}]"
        )

    def _remove(self, name: str) -> None:
        ends = self._turtles.pop(name)
        ends.close()
        self._closing.append(ends)
