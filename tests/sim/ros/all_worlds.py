"""Every world, named and generated, with nodes that drive, push, command and receive whatever there is."""

from __future__ import annotations

import math
import random
import zlib

from geometry_msgs.msg import Twist, Vector3
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu, JointState, LaserScan
from std_msgs.msg import Bool, Float64, Float64MultiArray
from tf2_msgs.msg import TFMessage
from turtlesim.msg import Pose

from sim import Recording, World, run
from sim.world.generate import KINDS
from sim.world.machines import ArmModel, CartPoleModel, JointModel, PondModel

SENSORS = {"odom": Odometry, "scan": LaserScan, "joint_states": JointState, "bumper": Bool, "imu/data": Imu}


class Listener(Node):
    """Receives topics, and logs once a second a number that every message changes."""

    def __init__(self, name, topics):
        super().__init__(name)
        self.received = 0
        for topic, kind in topics.items():
            self.create_subscription(kind, topic, self.on_message, 10, raw=True)
        self.create_timer(1.0, self.tell)

    def on_message(self, raw):
        self.received = zlib.crc32(raw, self.received)

    def tell(self):
        self.get_logger().info(f"{self.received}")


class Explorer(Listener):
    """Drives about, turns where something is near, but often tries to push it first."""

    def __init__(self, robots):
        names = {f"{robot}/{topic}": kind for robot in robots for topic, kind in SENSORS.items()}
        super().__init__("explorer", {**SENSORS, **names, "/tf": TFMessage, "/clock": Clock})
        self.create_subscription(LaserScan, "scan", self.drive, 10)
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)

    def drive(self, scan):
        near = min((r for r in [*scan.ranges[:30], *scan.ranges[-30:]] if r > 0), default=math.inf)
        command = Twist()
        bold = near > 0.3 or random.random() < 0.7
        command.linear.x, command.angular.z = (0.5, random.uniform(-0.5, 0.5)) if bold else (0.0, 2.5)
        self.publisher.publish(command)


class Operator(Listener):
    """Moves a machine to and fro."""

    kinds = {  # noqa: RUF012
        JointModel: ("joint_commands", lambda wave: Float64(data=wave)),
        ArmModel: ("joint_commands", lambda wave: Float64MultiArray(data=[wave, -wave])),
        CartPoleModel: ("cart_effort", lambda wave: Float64(data=wave)),
        PondModel: ("turtle1/cmd_vel", lambda wave: Twist(linear=Vector3(x=wave), angular=Vector3(z=1.0))),
    }

    def __init__(self, machine):
        received = {"joint_states": JointState, "/tf": TFMessage, "/clock": Clock, "turtle1/pose": Pose}
        super().__init__("operator", received)
        topic, self.command = self.kinds[type(machine)]
        self.publisher = self.create_publisher(type(self.command(0.0)), topic, 10)
        self.begin = self.get_clock().now()
        self.create_timer(0.02, self.move)

    def move(self):
        time = (self.get_clock().now() - self.begin).nanoseconds / 1e9
        self.publisher.publish(self.command(math.sin(3 * time)))


def worlds() -> dict[str, World]:
    """All named worlds, and two of each kind that can be generated, by name."""
    generated = [World.generate(kind, seed=seed) for kind in KINDS for seed in (1, 2)]
    return {world.name: world for world in [*map(World.load, World.names()), *generated]}


def in_use(world: World, seconds: float = 15.0, seed: int = 1) -> Recording:
    """A world in which everything moves and has a subscriber."""

    def program() -> Node:
        if world.machine is not None:
            return Operator(world.machine)
        return Explorer([robot.name for robot in world.robots])

    return run(program, world=world, seconds=seconds, seed=seed, quiet=True)
