"""What a world holds in place of robots: a joint, an arm, a cart with a pole, a pond with turtles."""

from typing import NamedTuple

from sim.world.machines.arm import Arm, ArmModel, ReachError
from sim.world.machines.cart_pole import CartPole, CartPoleModel, Push, State
from sim.world.machines.joint import Joint
from sim.world.machines.machine import Machine
from sim.world.machines.pond import Pond, PondModel
from sim.world.machines.servo import JointModel
from sim.world.machines.trajectory import Trajectory, Waypoint
from sim.world.machines.turtle import Pen, Rotation, Turtle
from sim.world.machines.urdf import urdf
from sim.world.model import Model


class Kind(NamedTuple):
    """One kind of machine, and its names in all other places."""

    key: str  # of its table in a world file
    model: type[Model]
    machine: type[Machine]  # made of a world and a seed
    node: str  # "module:class" of the node that speaks for it; only named, for nothing here knows ROS


KINDS = (
    Kind("joint", JointModel, Joint, "sim.ros.robots.joint:JointNode"),
    Kind("arm", ArmModel, Arm, "sim.ros.robots.arm:ArmNode"),
    Kind("cart_pole", CartPoleModel, CartPole, "sim.ros.robots.cart_pole:CartPoleNode"),
    Kind("pond", PondModel, Pond, "sim.ros.robots.turtlesim:Turtlesim"),
)


def kind_of(model: Model) -> Kind:
    """The kind of machine that a model describes."""
    return next(kind for kind in KINDS if kind.model is type(model))


__all__ = [
    "KINDS",
    "Arm",
    "ArmModel",
    "CartPole",
    "CartPoleModel",
    "Joint",
    "JointModel",
    "Kind",
    "Pen",
    "Pond",
    "PondModel",
    "Push",
    "ReachError",
    "Rotation",
    "State",
    "Trajectory",
    "Turtle",
    "Waypoint",
    "kind_of",
    "urdf",
]
