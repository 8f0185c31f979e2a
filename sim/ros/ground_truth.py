"""The world of a run: it moves along with time, and the true poses of everything in it are recorded."""

from __future__ import annotations

from sim.evidence import Pose, Recording
from sim.nanoseconds import SECOND, Nanoseconds
from sim.ros.robots.rates import SENSOR_RATE
from sim.world import Scene, simulate


class GroundTruth:
    """The scene of a recording's world. Raises WorldError when that can't be simulated."""

    def __init__(self, recording: Recording) -> None:
        self.scene: Scene = simulate(recording.world, recording.seed)
        self._recording = recording
        recording.drawing = self.scene.drawing
        # About 20 times a second, at the end of a step. Sensors' timers make a moment of each of these, but
        # for a pond's whose program starts later: there it is the next moment.
        steps = self.scene.rate // SENSOR_RATE
        self._every: Nanoseconds = round(SECOND * steps / self.scene.rate)
        self._next: Nanoseconds = 0

    def move_to(self, moment: Nanoseconds) -> None:
        """Advance the world to `moment`, before any node runs there."""
        self.scene.advance(moment / SECOND)
        if moment >= self._next:
            self._next = (moment // self._every + 1) * self._every
            self._track(moment / SECOND)

    def _track(self, stamp: float) -> None:
        """Record where everything is at `stamp`, in simulated seconds: path, tracks and contacts."""
        scene, recording = self.scene, self._recording
        first = scene.world.driven_body
        for body, pose in zip(scene.bodies, scene.poses, strict=True):
            poses = recording.path if body.name == first else recording.tracks.setdefault(body.name, [])
            poses.append(Pose(stamp, *pose))
        recording.contacts = scene.contacts
        recording.other_contacts = {
            name: robot.contacts for name, robot in scene.robots.items() if name != first
        }
