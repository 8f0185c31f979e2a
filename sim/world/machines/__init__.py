"""Machines that a world can contain instead of robots: a joint, an arm, a cart-pole, a pond with turtles."""

from collections.abc import Callable
from typing import Any, NamedTuple

from sim.world.machines.arm import Arm, ArmModel, ReachError
from sim.world.machines.cart_pole import CartPole, CartPoleModel, CartPoleState, Push
from sim.world.machines.joint import Joint
from sim.world.machines.pond import Pond, PondModel
from sim.world.machines.servo import JointModel
from sim.world.machines.trajectory import Trajectory, Waypoint
from sim.world.machines.turtle import Pen, Rotation, Turtle
from sim.world.machines.urdf import urdf
from sim.world.validated_model import Model


class MachineKind(NamedTuple):
    """One kind of machine: its table in world files, its classes and its ROS node."""

    key: str  # the name of its table in a world file
    model: type[Model]
    machine: Callable[[Any, int], Any]  # the machine's class, which makes a `Scene` of a world and a seed
    node: str  # "module:class" of its ROS node, as a string because this package doesn't import ROS


KINDS = (
    MachineKind("joint", JointModel, Joint, "sim.ros.robots.joint_node:JointNode"),
    MachineKind("arm", ArmModel, Arm, "sim.ros.robots.arm_node:ArmNode"),
    MachineKind("cart_pole", CartPoleModel, CartPole, "sim.ros.robots.cart_pole_node:CartPoleNode"),
    MachineKind("pond", PondModel, Pond, "sim.ros.robots.turtlesim:Turtlesim"),
)


def kind_of(model: Model) -> MachineKind:
    """The kind of machine with this type of model."""
    return next(kind for kind in KINDS if kind.model is type(model))


__all__ = [
    "KINDS",
    "Arm",
    "ArmModel",
    "CartPole",
    "CartPoleModel",
    "CartPoleState",
    "Joint",
    "JointModel",
    "MachineKind",
    "Pen",
    "Pond",
    "PondModel",
    "Push",
    "ReachError",
    "Rotation",
    "Trajectory",
    "Turtle",
    "Waypoint",
    "kind_of",
    "urdf",
]
