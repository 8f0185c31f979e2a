"""The programs that a world brings along: its robots and machines, each an ordinary node."""

from __future__ import annotations

from typing import Any

from sim.recording import Pose, Recording
from sim.ros.processes import Process
from sim.world import Scene


def machines(scene: Scene, recording: Recording | None) -> list[Process]:
    """What a run starts before the student's programs; without a recording, nothing is written down."""

    def robot() -> Any:
        from sim.ros.robot import Robot  # here, because it imports message packages, which takes a while

        return Robot(scene, recording)

    return [Process(robot)]


def track(scene: Scene, recording: Recording | None, stamp: float) -> None:
    """Write down where everything is at `stamp`, in simulated seconds: path, tracks and contacts."""
    if recording is None:
        return
    for body, pose in zip(scene.world.bodies, scene.poses, strict=True):
        poses = recording.path if body.name == "robot" else recording.tracks.setdefault(body.name, [])
        poses.append(Pose(stamp, *pose))
    recording.contacts = scene.contacts
