"""turtlesim_node as a program of a run, as launch files start it."""

from __future__ import annotations

import rclpy
from rclpy.executors import ExternalShutdownException

from sim.nanoseconds import SECOND
from sim.ros.fibers.exceptions import RunOver
from sim.ros.fibers.scheduler import engine
from sim.ros.robots.turtlesim import Turtlesim
from sim.world import World, simulate
from sim.world.machines import Pond

LEVEL = 20  # INFO


class OwnPond(Turtlesim):
    """A pond that is not the world's: it moves along with its own timer, and no picture shows it."""

    def tick(self) -> None:
        """As `Turtlesim`."""
        self.scene.advance(engine().now / SECOND)
        super().tick()


def main() -> None:
    """Be the world's pond in place of the world's own program; where there is none, be one more pond."""
    rclpy.init()
    try:
        scene = _take_over()
        rclpy.spin(OwnPond(_another()) if scene is None else Turtlesim(scene))
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


def _take_over() -> Pond | None:
    """The world's pond as at the beginning; its own program ends. None if it has none that still goes on."""
    run = engine()
    ponds = [(node, each) for each in run.processes for node in each.nodes if isinstance(node, Turtlesim)]
    for own, process in ponds:
        if process.from_course and process.main.thrown is None:  # it is not about to end
            run.logged(LEVEL, "launch", "The world's own turtlesim ends: this one has its pond from here on.")
            for fiber in run.fibers:
                if fiber.process is process and not fiber.done:
                    fiber.thrown = RunOver()
            own.scene.reset()
            own.scene.set_background(own.scene.world.machine.background)
            return own.scene
    if ponds:
        run.logged(LEVEL, "launch", "One more turtlesim: it has a pond of its own, which no picture shows.")
    return None


def _another() -> Pond:
    scene = simulate(World.load("turtlesim"), 0)
    scene.advance(engine().now / SECOND)
    return scene
