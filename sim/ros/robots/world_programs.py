"""The programs that belong to a world, each an ordinary node: robots, route drivers, machine, warehouse."""

from __future__ import annotations

import pkgutil
from typing import Any

from sim.ros.engine.program import Process
from sim.world import MobileRobot, OtherRobot, Scene, Simulation, World
from sim.world.machines import kind_of

# Nodes are imported when they are created, because importing their message packages takes a while.


def programs_of(scene: Scene) -> list[Process]:
    """The programs that a run starts before the student's; the run advances the scene."""
    world = scene.world
    if world.machine is not None:
        return [_machine(scene)]
    robots = [_robot(world, robot) for robot in scene.robots.values()]
    drivers = [_driver(robot, world) for robot in world.robots if robot.route]
    return robots + drivers + (_warehouse(scene) if world.warehouse is not None else [])


def _machine(scene: Scene) -> Process:
    def machine() -> Any:
        return pkgutil.resolve_name(kind_of(scene.world.machine).node)(scene)

    return Process(machine)


def _robot(world: World, mobile: MobileRobot) -> Process:
    def robot() -> Any:
        from sim.ros.robots.robot_node import Robot

        return Robot(world, mobile)

    return Process(robot)


def _driver(robot: OtherRobot, world: World) -> Process:
    def driver() -> Any:
        from sim.ros.robots.route_driver import RouteDriver

        return RouteDriver(robot, world.robot, world.lidar)

    return Process(driver)


def _warehouse(scene: Simulation) -> list[Process]:
    def map_server() -> Any:
        from sim.ros.robots.map_server import WarehouseMapServer

        return WarehouseMapServer(scene.world)

    def order_desk() -> Any:
        from sim.ros.robots.order_desk import OrderDesk

        return OrderDesk(scene.world, scene.robots, scene.seed)

    return [Process(map_server), Process(order_desk)]
