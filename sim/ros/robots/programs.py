"""The programs that a world brings along: its robots and machines, each an ordinary node."""

from __future__ import annotations

import pkgutil
from typing import Any

from sim.ros.engine.program import Process
from sim.world import MobileRobot, OtherRobot, RobotModel, Scene, World
from sim.world.machines import kind_of

# Nodes are imported when they are made: with them come message packages, which takes a while.


def programs_of(scene: Scene) -> list[Process]:
    """What a run starts before the student's programs. Whoever runs them moves the scene along with time."""
    world = scene.world
    if world.machine is not None:
        return [_machine(scene)]
    robots = [_robot(world, robot) for robot in scene.robots.values()]
    return robots + [_driver(robot, world.robot) for robot in world.robots if robot.route]


def _machine(scene: Scene) -> Process:
    def machine() -> Any:
        return pkgutil.resolve_name(kind_of(scene.world.machine).node)(scene)

    return Process(machine)


def _robot(world: World, mobile: MobileRobot) -> Process:
    def robot() -> Any:
        from sim.ros.robots.robot import Robot

        return Robot(world, mobile)

    return Process(robot)


def _driver(robot: OtherRobot, model: RobotModel) -> Process:
    def driver() -> Any:
        from sim.ros.robots.route_driver import RouteDriver

        return RouteDriver(robot, model)

    return Process(driver)
