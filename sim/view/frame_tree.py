"""Where frames are in a picture, by the transforms that nodes published on /tf and /tf_static."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from sim.world import World

MAP = "map"  # the frame of a world
DEEP = 20  # transforms from a frame to the map, at most: nodes may publish loops
Vector = tuple[float, float, float]


class Placement(NamedTuple):
    """A position (m) and a quaternion (x, y, z, w) in another frame."""

    position: Vector
    rotation: tuple[float, float, float, float]

    @property
    def yaw(self) -> float:
        """The heading of its x axis, seen from above (rad)."""
        x, y, z, w = self.rotation
        return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))

    @property
    def inverse(self) -> Placement:
        """The other frame, placed in this one."""
        x, y, z, w = self.rotation
        back = (-x, -y, -z, w)
        x, y, z = _turned(back, self.position)
        return Placement((-x, -y, -z), back)

    def of(self, inner: Placement) -> Placement:
        """Return what is placed in this frame, placed in the frame of this one."""
        x, y, z, w = self.rotation
        a, b, c, d = inner.rotation
        way = _turned(self.rotation, inner.position)
        return Placement(
            (self.position[0] + way[0], self.position[1] + way[1], self.position[2] + way[2]),
            (
                w * a + x * d + y * c - z * b,
                w * b - x * c + y * d + z * a,
                w * c + x * b - y * a + z * d,
                w * d - x * a - y * b - z * c,
            ),
        )


def _turned(rotation: Sequence[float], vector: Sequence[float]) -> Vector:
    x, y, z, w = rotation
    u, v, n = vector
    a, b, c = 2 * (y * n - z * v), 2 * (z * u - x * n), 2 * (x * v - y * u)
    return u + w * a + y * c - z * b, v + w * b + z * a - x * c, n + w * c + x * b - y * a


def flat(x: float, y: float, yaw: float) -> Placement:
    """A place on the floor (m, rad)."""
    return Placement((x, y, 0.0), (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)))


def placement(pose: Any) -> Placement:
    """Return the placement in a Pose or Transform. Raises ValueError for a quaternion without a direction."""
    place = getattr(pose, "translation", None) or pose.position
    turn = getattr(pose, "rotation", None) or pose.orientation
    rotation = turn.x, turn.y, turn.z, turn.w
    length = math.hypot(*rotation)
    if not 0.5 < length < 2:
        raise ValueError(f"{rotation} is no rotation")
    return Placement((place.x, place.y, place.z), tuple(value / length for value in rotation))


class FrameTree:
    """The newest transform of each frame.

    A robot's odom frame that no node has placed on the map is drawn where the robot started.
    """

    def __init__(self, world: World | None) -> None:
        self._parents: dict[str, tuple[str, Placement]] = {}
        self._starts = {MAP: flat(0.0, 0.0, 0.0)}
        for name, start in ({} if world is None else world.starts()).items():
            self._starts["odom" if name == "robot" else f"{name}/odom"] = flat(*start)
        if world is not None:
            self._starts["odom"] = self._starts["odom"].of(flat(*world.robot.odometry).inverse)

    def add(self, transforms: Any) -> None:
        """Take note of a tf2_msgs/TFMessage, or of None; what is no transform in it is left out."""
        for one in getattr(transforms, "transforms", ()):
            try:
                self._parents[_plain(one.child_frame_id)] = (
                    _plain(one.header.frame_id),
                    placement(one.transform),
                )
            except ValueError:
                continue

    @property
    def names(self) -> list[str]:
        """All frames that have a transform, and the frames that those are in."""
        parents = [parent for parent, _ in self._parents.values()]
        return list(dict.fromkeys([*parents, *self._parents]))

    def where(self, frame: str) -> Placement | None:
        """Return where a frame is on the map, or None if no transforms lead there."""
        found, name = flat(0.0, 0.0, 0.0), _plain(frame)
        for _ in range(DEEP):
            if name not in self._parents:
                start = self._starts.get(name)
                return start and start.of(found)
            name, inner = self._parents[name]
            found = inner.of(found)
        return None


def _plain(frame: str) -> str:
    return frame.lstrip("/")
