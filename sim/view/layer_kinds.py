"""What of a message is drawn into a world's picture: maps, plans, goals, poses, clouds of poses, images.

Lengths are in meters, in the frame of the world; `checkLayer` in web/layers.js parses all of it.
"""

from __future__ import annotations

import base64
import io
import itertools
import math
from typing import Any

import numpy as np
from PIL import Image

from sim.view.frame_tree import MAP, FrameTree, Placement, placement
from sim.view.strokes import thinned

KINDS = {
    "nav_msgs/msg/OccupancyGrid": "map",
    "nav_msgs/msg/Path": "plan",
    "geometry_msgs/msg/PoseStamped": "pose",  # or goal, by the topic's name
    "geometry_msgs/msg/PoseWithCovarianceStamped": "pose",
    "nav_msgs/msg/Odometry": "pose",
    "geometry_msgs/msg/PoseArray": "cloud",
    "nav2_msgs/msg/ParticleCloud": "cloud",
    "sensor_msgs/msg/Image": "image",
    "tf2_msgs/msg/TFMessage": "frames",
}
QUIET = frozenset({"pose", "cloud", "image", "frames"})  # drawn where the reader asks for them
OPEN = "/particle_cloud"  # a quiet layer that is drawn until the reader hides it
CELLS, POINTS, CLOUD = 160_000, 200, 120  # limits of a map, a plan and a cloud of poses
FAR = 10_000.0  # m; farther than anything in a world
PIXELS, QUALITY = 160, 50  # the width of a stored image; smaller ones are doubled, to keep their colors
CHANNELS = {"rgb8": 3, "bgr8": 3, "mono8": 1}


def kind_of(topic: str, kind: str) -> str | None:
    """The kind of layer that messages of a topic and type are; None if they aren't drawn.

    A PoseStamped is a goal on a topic whose name has that word, and otherwise a pose.
    """
    found = KINDS.get(kind)
    return "goal" if kind == "geometry_msgs/msg/PoseStamped" and "goal" in topic else found


def layer_data(kind: str, message: Any, frames: FrameTree) -> Any:
    """Return what is drawn of a message, for JSON; None if its frame is not on the map, or a map is turned.

    Raises an exception for values that are in no world.
    """
    if kind == "image":
        return image_data(message)
    place = frames.where(message.header.frame_id)
    if place is None or (kind == "map" and message.header.frame_id.lstrip("/") != MAP):
        return None
    return _CONVERTERS[kind](message, place)


def frame_data(place: Placement) -> list[float]:
    """x, y, and the rotation as a quaternion."""
    return [*meters(*place.position[:2]), *(round(value, 4) for value in place.rotation)]


def _grid(message: Any, _: Placement) -> dict[str, Any] | None:
    return grid_data(message)


def grid_data(message: Any) -> dict[str, Any] | None:
    """A map as runs of equal cells, row by row; larger cells if it has too many; None if it is turned."""
    info, origin = message.info, message.info.origin
    count = info.width * info.height
    if not count or len(message.data) != count or abs(origin.orientation.z) > 1e-3:
        return None
    step = math.ceil(math.sqrt(max(count / CELLS, 1)))
    cells = np.array(message.data, dtype=np.int16).reshape(info.height, info.width)
    for axis, size in enumerate(cells.shape):
        cells = np.maximum.reduceat(cells, range(0, size, step), axis)
    groups = itertools.groupby(np.clip(cells, -1, 100).ravel().tolist())
    runs = [[value, len(list(group))] for value, group in groups]
    place = meters(origin.position.x, origin.position.y, info.resolution * step)
    return {"width": cells.shape[1], "place": place, "runs": runs}


def _plan(message: Any, place: Placement) -> list[list[float]]:
    poses = thinned(message.poses, POINTS)
    return [meters(*_on_map(place, pose.pose)[:2]) for pose in poses]


def _goal(message: Any, place: Placement) -> list[float]:
    return meters(*_on_map(place, message.pose))


def _pose(message: Any, place: Placement) -> list[float]:
    """x, y, yaw, and the covariance of x and y (m²) as xx, xy, yy; zeros if the message has none."""
    covariance = getattr(message.pose, "covariance", None)
    pose = message.pose if covariance is None else message.pose.pose
    spread = np.zeros((2, 2)) if covariance is None else np.reshape(covariance, (6, 6))[:2, :2]
    cos, sin = math.cos(place.yaw), math.sin(place.yaw)
    turn = np.array([[cos, -sin], [sin, cos]])
    (xx, xy), (_, yy) = turn @ spread @ turn.T
    if not (xx >= 0 and yy >= 0):
        raise ValueError("a variance is below 0")
    return [*meters(*_on_map(place, pose)), *(round(float(value), 6) for value in (xx, xy, yy))]


def _cloud(message: Any, place: Placement) -> list[list[float]]:
    poses = message.poses if hasattr(message, "poses") else [one.pose for one in message.particles]
    return [[round(value, 2) for value in meters(*_on_map(place, pose))] for pose in thinned(poses, CLOUD)]


def _on_map(place: Placement, pose: Any) -> tuple[float, float, float]:
    """x, y (m) and yaw (rad) of a geometry_msgs/Pose in a frame that is at this place."""
    found = place.of(placement(pose))
    return found.position[0], found.position[1], found.yaw


def image_data(message: Any) -> dict[str, Any] | None:
    """An image as WebP in base64, and its size in pixels; None for an encoding that isn't shown."""
    channels, width, height = CHANNELS.get(message.encoding), message.width, message.height
    if channels is None or not width * height:
        return None
    rows = np.frombuffer(bytes(message.data), np.uint8).reshape(height, message.step)
    pixels = rows[:, : channels * width].reshape(height, width, channels)
    pixels = pixels[..., ::-1] if message.encoding == "bgr8" else pixels
    image = Image.fromarray(np.ascontiguousarray(pixels.repeat(3, 2) if channels == 1 else pixels))
    if 2 * width <= PIXELS:
        image = image.resize((2 * width, 2 * height), Image.Resampling.NEAREST)
    image.thumbnail((PIXELS, PIXELS))
    target = io.BytesIO()
    image.save(target, "WEBP", quality=QUALITY)
    return {"width": width, "height": height, "webp": base64.b64encode(target.getvalue()).decode()}


def meters(*values: float) -> list[float]:
    """The values, rounded. Raises ValueError if one is in no world, such as NaN."""
    if not all(abs(value) < FAR for value in values):
        raise ValueError(f"{values} is too far")
    return [round(float(value), 4) for value in values]


_CONVERTERS = {"map": _grid, "plan": _plan, "goal": _goal, "pose": _pose, "cloud": _cloud}
