"""`Scene`: the interface of a running simulation, of mobile robots or of a machine."""

from __future__ import annotations

from typing import Protocol

from sim.world.bodies import Body
from sim.world.contacts import Contact
from sim.world.lidar import Scan
from sim.world.machines import kind_of
from sim.world.mobile_robot import MobileRobot
from sim.world.pen_drawing import PenDrawing
from sim.world.simulation import Simulation
from sim.world.world import World


class Scene(Protocol):
    """A simulated world that advances in time, from 0 on."""

    world: World
    robots: dict[str, MobileRobot]  # by name, the first is "robot"; empty with a machine
    drawing: PenDrawing | None  # the pens' drawing; None without pens
    rate: float  # physics steps per second

    @property
    def time(self) -> float:
        """Simulated time of the last physics step, s."""

    def advance(self, until: float) -> None:
        """Run the physics steps, if any are due, that end at or before `until` (s).

        The times of the steps don't depend on how often this is called.
        """

    @property
    def bodies(self) -> tuple[Body, ...]:
        """The moving bodies now: `world.bodies`, unless bodies were added or removed."""

    @property
    def poses(self) -> list[tuple[float, float, float]]:
        """(x, y, yaw) of each of `bodies`, in their order, in the map frame."""

    @property
    def contacts(self) -> list[Contact]:
        """All contacts of the robot "robot" so far, oldest first."""

    @property
    def last_scan(self) -> Scan | None:
        """The latest scan; None before the first one, and without a lidar."""

    def discard_history(self) -> None:
        """Discard the contacts that have ended, to bound the memory of a run without an end."""


def simulate(world: World, seed: int) -> Scene:
    """The simulation of a world; the seed is for everything random in it."""
    if world.machine is None:
        return Simulation(world, seed)
    machine: Scene = kind_of(world.machine).machine(world, seed)
    return machine
