"""Base class of the machines' nodes: clock, joint states and clear errors for invalid commands."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import String

from sim.nanoseconds import SECOND
from sim.ros.messages.template import STAMP, Template
from sim.ros.robots.rates import MAX_COMMAND_RATE, SENSOR_RATE
from sim.world import CommandError


class MachineNode(Node):
    """A machine as an ordinary node. Publishes /joint_states, and /clock at 20 Hz, both reliable.

    The run advances the machine: `scene` has its state at the node's time.

    rate: of /joint_states, in Hz; a multiple of 20.
    """

    def __init__(
        self,
        scene: Any,
        name: str,
        joints: Sequence[str],
        rate: int = SENSOR_RATE,
    ) -> None:
        super().__init__(name, start_parameter_services=False)
        self.scene = scene
        zeros = [0.0] * len(joints)
        self.clock_message = Template(Clock(), ["clock.sec", "clock.nanosec"])
        message = JointState(name=joints, position=zeros, velocity=zeros)
        self.joint_message = Template(message, [*STAMP, "position", "velocity"])
        self.clock_pub = self.create_publisher(Clock, "/clock", 1)
        self.joint_pub = self.create_publisher(JointState, "joint_states", 10)
        self._ticks, self._ticks_per_sense = 0, rate // SENSOR_RATE
        self._period = 1 / rate
        self._commands = 0  # since the last count, 0.05 s ago

    def start_publishing(self) -> None:
        """Publish for the first time, and start the timer. Called at the end of each machine's `__init__`."""
        self._tick()
        self.create_timer(self._period, self._tick)

    def describe(self, urdf: str) -> None:
        """Publish the machine's URDF on /robot_description, latched."""
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_publisher(String, "robot_description", latched).publish(String(data=urdf))

    def joints(self) -> tuple[float, ...]:
        """The measured positions, then velocities, of all joints."""
        raise NotImplementedError

    def sense(self, stamp: tuple[int, int]) -> None:
        """Publish further sensors, 20 times a second; the stamp is (s, ns)."""

    def apply_command(self, command: Callable[..., None], *values: Any) -> bool:
        """Execute a command; returns False and logs an error if it is invalid."""
        self._commands += 1
        try:
            command(*values)
        except CommandError as error:
            self.get_logger().error(str(error), throttle_duration_sec=1.0)
            return False
        return True

    def _tick(self) -> None:
        stamp = divmod(self.get_clock().now().nanoseconds, SECOND)
        self.joint_pub.publish(self.joint_message.fill(*stamp, *self.joints()))
        if self._ticks % self._ticks_per_sense == 0:
            self._count_commands()
            self.clock_pub.publish(self.clock_message.fill(*stamp))
            self.sense(stamp)
        self._ticks += 1

    def _count_commands(self) -> None:
        if self._commands > MAX_COMMAND_RATE / SENSOR_RATE:
            self.get_logger().warning(
                f"More than {MAX_COMMAND_RATE} commands arrived in one second; 100 are enough: check the "
                "period of the timer that sends them.",
                throttle_duration_sec=1.0,
            )
        self._commands = 0
