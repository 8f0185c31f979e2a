"""The world of a run: it moves along with time, and where everything truly is gets written down."""

from __future__ import annotations

from sim.evidence import Pose, Recording
from sim.nanoseconds import SECOND, Nanoseconds
from sim.ros.robots.rates import SENSOR_RATE
from sim.world import Scene, simulate

TRACKED_EVERY: Nanoseconds = SECOND // SENSOR_RATE


class GroundTruth:
    """The scene of a recording's world. Raises WorldError when that can't be simulated."""

    def __init__(self, recording: Recording) -> None:
        self.scene: Scene = simulate(recording.world, recording.seed)
        self._recording = recording

    def move_to(self, moment: Nanoseconds) -> None:
        """Let the world be where it is at `moment`, before any node does something then."""
        self.scene.advance(moment / SECOND)
        if moment % TRACKED_EVERY == 0:  # the sensors' timers make a moment of each of these
            self._track(moment / SECOND)

    def _track(self, stamp: float) -> None:
        """Write down where everything is at `stamp`, in simulated seconds: path, tracks and contacts."""
        scene, recording = self.scene, self._recording
        for body, pose in zip(scene.world.bodies, scene.poses, strict=True):
            poses = recording.path if body.name == "robot" else recording.tracks.setdefault(body.name, [])
            poses.append(Pose(stamp, *pose))
        recording.contacts = scene.contacts
