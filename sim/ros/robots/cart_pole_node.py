"""The cart with its pole as an ordinary ROS 2 node."""

from __future__ import annotations

from std_msgs.msg import Float64

from sim.ros.robots.machine_node import MachineNode
from sim.world.machines import CartPole

RATE = 100  # Hz


class CartPoleNode(MachineNode):
    """Subscribes /cart_effort (std_msgs/Float64: the force, N); publishes /joint_states at 100 Hz.

    Its joints are slider_joint (m, m/s, to the right) and pole_joint (rad, rad/s; 0 upright, positive
    counter-clockwise).
    """

    def __init__(self, scene: CartPole) -> None:
        super().__init__(scene, "cart_pole", ["slider_joint", "pole_joint"], RATE)
        self.create_subscription(Float64, "cart_effort", self.on_effort, 10)
        self.start_publishing()

    def on_effort(self, effort: Float64) -> None:
        """Push with this force from now on."""
        self.apply_command(self.scene.command, effort.data)

    def joints(self) -> tuple[float, ...]:
        """Measured positions of cart and pole, then their rates."""
        return self.scene.measure()
