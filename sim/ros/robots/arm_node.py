"""The arm of two joints as an ordinary ROS 2 node."""

from __future__ import annotations

import itertools
import math

from geometry_msgs.msg import TransformStamped, Vector3
from std_msgs.msg import Float64MultiArray, Header
from tf2_msgs.msg import TFMessage

from sim.ros.messages.template import STAMP, Template
from sim.ros.robots.machine_node import MachineNode
from sim.ros.robots.trajectory_server import TrajectoryServer
from sim.world.machines import Arm, urdf

JOINTS = ["shoulder_joint", "elbow_joint"]
FRAMES = ["base_link", "upper_arm", "forearm", "tip"]


class ArmNode(MachineNode):
    """Moves to positions, or along trajectories; the newest command wins.

    Subscribes /joint_commands (std_msgs/Float64MultiArray: the angles of shoulder and elbow, rad). Publishes
    at 20 Hz /joint_states and /tf (base_link -> upper_arm -> forearm -> tip), and once /robot_description,
    latched. Offers the action /arm_controller/follow_joint_trajectory (control_msgs/FollowJointTrajectory).
    """

    def __init__(self, scene: Arm) -> None:
        super().__init__(scene, "arm", JOINTS[:: -1 if scene.model.elbow_first else 1])
        self.tf_message = self._transforms()
        self.tf_pub = self.create_publisher(TFMessage, "/tf", 100)
        self.create_subscription(Float64MultiArray, "joint_commands", self.on_command, 10)
        self._trajectories = TrajectoryServer(self, JOINTS)
        self.describe(urdf("arm", JOINTS, scene.model.joints, FRAMES))
        self.start_publishing()

    def on_command(self, command: Float64MultiArray) -> None:
        """Turn the joints to these angles from now on."""
        if self.apply_command(self.scene.command, list(command.data)):
            self._trajectories.abort_replaced("a command on /joint_commands")

    def joints(self) -> tuple[float, ...]:
        """Measured angles (rad) and then rates (rad/s), in the order of the names in /joint_states."""
        order = -1 if self.scene.model.elbow_first else 1
        shoulder, elbow, *rates = self.scene.measure()
        return *(shoulder, elbow)[::order], *rates[::order]

    def sense(self, stamp: tuple[int, int]) -> None:
        """Publish the links' transforms, and monitor the active trajectory."""
        turns = [f(angle / 2) for angle in self.scene.positions for f in (math.sin, math.cos)]
        self.tf_pub.publish(self.tf_message.fill(*stamp, *turns[:2], *stamp, *turns[2:], *stamp))
        self._trajectories.watch(stamp)

    def _transforms(self) -> Template:
        ends = [0.0, *(joint.length for joint in self.scene.model.joints)]
        message, fields = TFMessage(), []
        frames = zip(ends, itertools.pairwise(FRAMES), strict=True)
        for number, (x, (parent, child)) in enumerate(frames):
            transform = TransformStamped(header=Header(frame_id=parent), child_frame_id=child)
            transform.transform.translation = Vector3(x=x)
            message.transforms.append(transform)
            fields += [f"transforms.{number}.{field}" for field in STAMP]
            if child != "tip":
                fields += [f"transforms.{number}.transform.rotation.{axis}" for axis in "zw"]
        return Template(message, fields)
