"""Driving by hand: what is held on the keyboard or the pad becomes /cmd_vel."""

from __future__ import annotations

from typing import Any

from rclpy.node import Node

from sim.ros.fibers.scheduler import engine
from sim.ros.robots.velocity import VelocityPublisher

RATE = 20.0  # Hz, while something is held
SPEED, TURN = 0.4, 1.0  # m/s and rad/s of a key that is held


class Teleop(Node):
    """Publishes /cmd_vel (geometry_msgs/Twist) at 20 Hz while the user of `play` holds a key or the pad.

    Once it is let go, it publishes a zero, and then nothing. Parameters: `speed` (m/s, forwards) and `turn`
    (rad/s, counter-clockwise) of a key that is held; `stamped`, true for geometry_msgs/TwistStamped instead.
    Remappings work as with any node.
    """

    def __init__(self, **keywords: Any) -> None:
        super().__init__("teleop", **keywords)
        self.declare_parameter("speed", SPEED)
        self.declare_parameter("turn", TURN)
        self.declare_parameter("stamped", False)
        self._velocity = VelocityPublisher(self, self.get_parameter("stamped").value)
        self._drove = False
        self.create_timer(1 / RATE, self._tick)

    def _tick(self) -> None:
        run = engine()
        forward, left = run.held if run is not None else (0.0, 0.0)
        drives = bool(forward or left)
        if drives or self._drove:
            speed, turn = self.get_parameter("speed").value, self.get_parameter("turn").value
            self._velocity.send(forward * speed, left * turn)
        self._drove = drives
