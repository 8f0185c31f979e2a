"""Machines that are bolted down and move their links: a joint, an arm, a cart with a pole. libm only."""

from sim.world.machines.arm import Arm, ArmModel, ReachError
from sim.world.machines.cart_pole import CartPole, CartPoleModel, State
from sim.world.machines.joint import Joint
from sim.world.machines.servo import JointModel
from sim.world.machines.trajectory import Trajectory, Waypoint

__all__ = [
    "Arm",
    "ArmModel",
    "CartPole",
    "CartPoleModel",
    "Joint",
    "JointModel",
    "ReachError",
    "State",
    "Trajectory",
    "Waypoint",
]
