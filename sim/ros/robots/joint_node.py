"""A single position-controlled joint as an ordinary ROS 2 node."""

from __future__ import annotations

from std_msgs.msg import Float64

from sim.ros.robots.machine_node import MachineNode
from sim.world.machines import Joint, urdf


class JointNode(MachineNode):
    """Subscribes /joint_commands (std_msgs/Float64: the angle, rad); publishes /joint_states at 20 Hz.

    And once /robot_description, latched.
    """

    def __init__(self, scene: Joint) -> None:
        super().__init__(scene, "joint", ["joint"])
        self.create_subscription(Float64, "joint_commands", self.on_command, 10)
        self.describe(urdf("joint", ["joint"], [scene.world.machine], ["base_link", "link", "tip"]))
        self.start_publishing()

    def on_command(self, command: Float64) -> None:
        """Turn to this angle from now on."""
        self.apply_command(self.scene.command, command.data)

    def joints(self) -> tuple[float, ...]:
        """The joint's measured angle (rad) and rate (rad/s)."""
        return self.scene.measure()
