"""`plot_ellipses`: where a robot was, and where a topic says that it was, with the topic's covariance."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.patches import Ellipse

from sim.evidence import Recording, Seconds, since_start
from sim.view.path_plot import world_figure
from sim.view.plot import CAUTION, PATH, Plot, legend_beside, note_failure

SIGMAS = 2.45  # of an ellipse: 95 % of a Gaussian's positions are inside


def plot_ellipses(recording: Recording, topic: str = "/odom", every: Seconds = 2.0) -> Plot:
    """Plot the robot's true path, the positions on a topic, and an ellipse of 95 % every so many seconds.

    topic: of nav_msgs/Odometry or geometry_msgs/PoseWithCovarianceStamped, in a frame that begins where the
    robot starts, or in map.
    Raises ValueError for a topic without such messages, or a run in which nothing moves.
    """
    figure, axes = world_figure(recording)
    messages = recording.messages(topic)
    rows = [row for row in messages if hasattr(getattr(row.message, "pose", None), "covariance")]
    if not rows:
        raise ValueError(f"no message on {topic} has a pose with a covariance; check the topic's name")
    path = np.array([(pose.x, pose.y) for pose in recording.path])
    axes.plot(*path.T, color=PATH, label="true path")
    places, due = [], 0.0
    for row in rows:
        x, y, spread = _in_map(recording, row.message)
        places.append((x, y))
        stamp = since_start(row.message.header.stamp)
        if stamp >= due:
            due = stamp + every
            if np.isfinite(spread).all():
                axes.add_patch(ellipse(x, y, spread))
            true = min(recording.path, key=lambda pose: abs(pose.stamp - stamp))
            axes.plot([x, true.x], [y, true.y], color=CAUTION, linewidth=1.0)
    axes.plot(*np.array(places).T, "--", color=CAUTION, label=topic)
    axes.plot([], [], color=CAUTION, linewidth=6, alpha=0.3, label="95 % ellipse")
    axes.autoscale_view()
    legend_beside(axes)
    return note_failure(figure, recording)


def ellipse(x: float, y: float, spread: np.ndarray) -> Ellipse:
    """The ellipse around a point (m) that contains 95 % of the positions with a covariance (m²)."""
    sizes, axes = np.linalg.eigh((spread + spread.T) / 2)
    width, height = 2 * SIGMAS * np.sqrt(np.maximum(sizes, 0.0))
    turn = math.degrees(math.atan2(axes[1, 0], axes[0, 0]))
    return Ellipse((x, y), width, height, angle=turn, facecolor=CAUTION, alpha=0.3, edgecolor=CAUTION)


def _in_map(recording: Recording, message: Any) -> tuple[float, float, np.ndarray]:
    """Position (m) of a message, and the covariance of x and y (m²), in the map frame."""
    place = message.pose.pose.position
    spread = np.reshape(message.pose.covariance, (6, 6))[:2, :2]
    if message.header.frame_id == "map":
        return place.x, place.y, spread
    assert recording.world is not None  # `world_figure` has drawn it
    x0, y0, yaw0 = recording.world.start
    c, s = math.cos(yaw0), math.sin(yaw0)
    turned = np.array([[c, -s], [s, c]])
    x, y = turned @ (place.x, place.y)
    return x0 + x, y0 + y, turned @ spread @ turned.T
