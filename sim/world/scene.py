"""What a world's simulation is to those that run it or draw it, whatever moves in it."""

from __future__ import annotations

from typing import Protocol

from sim.world.bodies import Body
from sim.world.contacts import Contact
from sim.world.description import World
from sim.world.drawing import Drawing
from sim.world.lidar import Scan
from sim.world.machines import kind_of
from sim.world.mobile_robot import MobileRobot
from sim.world.simulation import Simulation


class Scene(Protocol):
    """A world on its way through time, from 0 on."""

    world: World
    robots: dict[str, MobileRobot]  # by name, the first is "robot"; none where there is a machine
    drawing: Drawing | None  # what pens drew; None where nobody has one
    rate: float  # physics steps in a second

    @property
    def time(self) -> float:
        """Simulated time of the last physics step, s."""

    def advance(self, until: float) -> None:
        """Do the physics steps, if any are due, that end at or before `until` (s).

        Where the steps lie doesn't depend on how often this is called.
        """

    @property
    def bodies(self) -> tuple[Body, ...]:
        """All that moves now: `world.bodies`, where nothing comes or goes."""

    @property
    def poses(self) -> list[tuple[float, float, float]]:
        """(x, y, yaw) of each of `bodies`, in their order, in the map frame."""

    @property
    def contacts(self) -> list[Contact]:
        """All touches of the robot "robot" so far, oldest first."""

    @property
    def last_scan(self) -> Scan | None:
        """What the lidar saw last; None before the first scan, and where there is no lidar."""

    def forget(self) -> None:
        """Drop the contacts that have ended, for a run without an end."""


def simulate(world: World, seed: int) -> Scene:
    """The simulation that a world asks for; the seed is for all that chance decides in it."""
    if world.machine is None:
        return Simulation(world, seed)
    return kind_of(world.machine).machine(world, seed)
