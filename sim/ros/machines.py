"""The programs that a world brings along: its robots and machines, each an ordinary node."""

from __future__ import annotations

import importlib
from typing import Any

from sim.recording import Pose, Recording
from sim.ros.processes import Process
from sim.world import MobileRobot, OtherRobot, Scene, Simulation
from sim.world.machines import ArmModel, CartPoleModel, JointModel

SENSOR_RATE = 20
"""How often in a second most sensors speak, and everything is tracked."""
MOST_COMMANDS = 1000
"""In a second; ten times what the quickest robots take."""

# Named, not imported: with them comes the import of message packages, which takes a while.
_MACHINES = {
    JointModel: ("sim.ros.joint", "JointNode"),
    ArmModel: ("sim.ros.arm", "ArmNode"),
    CartPoleModel: ("sim.ros.cart_pole", "CartPoleNode"),
}


def machines(scene: Any, recording: Recording | None) -> list[Process]:
    """What a run starts before the student's programs; without a recording, nothing is written down."""
    world = scene.world
    if world.machine is not None:
        return [_machine(scene, recording)]
    robots = [
        _robot(scene, robot, recording if robot.name == "robot" else None) for robot in scene.robots.values()
    ]
    return robots + [_driver(robot, world.robot.radius) for robot in world.robots if robot.route]


def _machine(scene: Any, recording: Recording | None) -> Process:
    module, name = _MACHINES[type(scene.world.machine)]

    def machine() -> Any:
        return getattr(importlib.import_module(module), name)(scene, recording)

    return Process(machine)


def _robot(scene: Simulation, mobile: MobileRobot, recording: Recording | None) -> Process:
    def robot() -> Any:
        from sim.ros.robot import Robot  # here, because it imports message packages, which takes a while

        return Robot(scene, mobile, recording)

    return Process(robot)


def _driver(robot: OtherRobot, radius: float) -> Process:
    def driver() -> Any:
        from sim.ros.route_driver import RouteDriver

        return RouteDriver(robot, radius)

    return Process(driver)


def track(scene: Scene, recording: Recording | None, stamp: float) -> None:
    """Write down where everything is at `stamp`, in simulated seconds: path, tracks and contacts."""
    if recording is None:
        return
    for body, pose in zip(scene.world.bodies, scene.poses, strict=True):
        poses = recording.path if body.name == "robot" else recording.tracks.setdefault(body.name, [])
        poses.append(Pose(stamp, *pose))
    recording.contacts = scene.contacts
