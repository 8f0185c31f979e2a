"""turtlesim_node as a program of a run, as launch files start it."""

from __future__ import annotations

from typing import Any

import rclpy
from rclpy.executors import ExternalShutdownException

from sim.nanoseconds import SECOND
from sim.ros.fibers.exceptions import RunOver
from sim.ros.fibers.scheduler import engine
from sim.ros.robots.turtlesim import Turtlesim
from sim.world import World, simulate
from sim.world.machines import Pond

LOG_LEVEL = 20  # INFO


class OwnPond(Turtlesim):
    """A further pond, which its own timer advances and no picture shows."""

    def tick(self) -> None:
        """Work like `Turtlesim.tick`, after advancing the pond."""
        self.scene.advance(engine().now / SECOND)
        super().tick()


def main() -> None:
    """Take the world's pond over from its own program or, if there is none left, create a further pond."""
    rclpy.init()
    try:
        scene = _take_over_pond()
        rclpy.spin(OwnPond(_create_pond()) if scene is None else Turtlesim(scene))
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


def _take_over_pond() -> Pond | None:
    """The world's pond, reset, after ending its own program. None if no such program is running."""
    run = engine()
    ponds = [(node, each) for each in run.programs for node in each.nodes if isinstance(node, Turtlesim)]
    for own, process in ponds:
        if process.from_course and process.main.thrown is None:  # it is not already ending
            run.output.log(
                LOG_LEVEL, "launch", "The world's own turtlesim ends: this one has its pond from here on."
            )
            for fiber in run.fibers:
                if fiber.process is process and not fiber.done:
                    fiber.thrown = RunOver()
            own.scene.reset()
            own.scene.set_background(own.scene.world.machine.background)
            return own.scene
    if ponds:
        run.output.log(
            LOG_LEVEL, "launch", "One more turtlesim: it has a pond of its own, which no picture shows."
        )
    return None


def _create_pond() -> Pond:
    scene: Any = simulate(World.load("turtlesim"), 0)
    scene.advance(engine().now / SECOND)
    return scene
