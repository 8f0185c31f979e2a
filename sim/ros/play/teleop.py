"""Manual driving: keys or the pad of the live picture are published as velocity commands."""

from __future__ import annotations

from typing import Any, NamedTuple

from rclpy.node import Node

from sim.ros.fibers.scheduler import engine
from sim.ros.robots.velocity import VelocityPublisher
from sim.world import World

RATE = 20.0  # Hz, while a key is held
SPEED, TURN = 0.4, 1.0  # m/s and rad/s while a key is held
TURTLE_SPEED, TURTLE_TURN = 2.0, 2.0


class TeleopSettings(NamedTuple):
    """Settings of the keys: topic, whether its type is TwistStamped, speed (m/s), turning rate (rad/s)."""

    topic: str = "cmd_vel"
    stamped: bool = False
    speed: float = SPEED
    turn: float = TURN


def teleop_settings(world: World | None) -> TeleopSettings | None:
    """Return how keys drive the first robot or turtle of a world; None if it has none."""
    if world is None or world.driven_body is None:
        return None
    if world.machine is None:
        return TeleopSettings(stamped=world.robot.stamped)
    return TeleopSettings(f"{world.driven_body}/cmd_vel", speed=TURTLE_SPEED, turn=TURTLE_TURN)


class Teleop(Node):
    """Publishes /cmd_vel (geometry_msgs/Twist) at 20 Hz while the user of `play` holds a key or the pad.

    On release it publishes one zero command, and then nothing. Parameters: `speed` (m/s, forwards) and `turn`
    (rad/s, counter-clockwise) while a key is held; `stamped`, true for geometry_msgs/TwistStamped; `topic`,
    by default cmd_vel. Remappings work as with any node.
    """

    def __init__(self, **keywords: Any) -> None:
        super().__init__("teleop", **keywords)
        self.declare_parameter("speed", SPEED)
        self.declare_parameter("turn", TURN)
        stamped = self.declare_parameter("stamped", False).value
        self._velocity = VelocityPublisher(self, stamped, self.declare_parameter("topic", "cmd_vel").value)
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
