"""`plot_map`: an occupancy grid as in RViz, with a path, the robot and its driven path; meters, map frame."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.patches import Circle

from sim.evidence import Recording
from sim.view.plot import CAUTION, PATH, Plot, legend_beside, note_failure, plot

UNKNOWN, FREE, OCCUPIED = "#b9c4c2", "#ffffff", "#23292f"
RADIUS = 0.1  # of the robot's marker, m
# Values 0 to 100 as colors: free, then darker with higher cost, then occupied.
_COSTS = np.linspace((0.94, 0.97, 1.0, 1.0), (0.45, 0.62, 0.80, 1.0), 99)
_SHADES = ListedColormap([UNKNOWN, FREE, *_COSTS, OCCUPIED])


def plot_map(grid: Any, path: Any = None, *, robot: Any = None, drive: Recording | None = None) -> Plot:
    """Plot a nav_msgs/OccupancyGrid, whose origin must not be rotated.

    path: a nav_msgs/Path, or points (x, y).
    robot: its pose, (x, y, yaw) in meters and radians.
    drive: a run whose driven path is drawn too, with the robot at its end.
    Raises ValueError for a map without cells.
    """
    info = grid.info
    if not info.width * info.height or len(grid.data) != info.width * info.height:
        raise ValueError(
            f"this map has no cells to draw: it is {info.width} by {info.height} cells, "
            f"and data holds {len(grid.data)} values"
        )
    figure, axes = plot(6.4, 4.8)
    _draw_cells(axes, grid)
    if path is not None:
        _draw_path(axes, list(_points(path)))
    if drive is not None and drive.path:
        track = [pose.x for pose in drive.path], [pose.y for pose in drive.path]
        axes.plot(*track, color=PATH, linewidth=1.6, label="drive")
        robot = drive.path[-1][1:4] if robot is None else robot
    if robot is not None:
        _draw_robot(axes, *robot)
    if axes.get_legend_handles_labels()[0]:
        legend_beside(axes)
    axes.set(aspect="equal", xlabel="x (m)", ylabel="y (m)")
    axes.set_title(f"{info.width} by {info.height} cells of {info.resolution:.3g} m")
    return figure if drive is None else note_failure(figure, drive)


def _draw_cells(axes: Axes, grid: Any) -> None:
    info, corner = grid.info, grid.info.origin.position
    values = np.array(grid.data, dtype=np.int16).reshape(info.height, info.width)
    extent = (
        corner.x,
        corner.x + info.width * info.resolution,
        corner.y,
        corner.y + info.height * info.resolution,
    )
    shades = np.clip(values, -1, 100) + 1
    look = {"cmap": _SHADES, "vmin": 0, "vmax": 101, "interpolation": "nearest"}
    axes.imshow(shades, origin="lower", extent=extent, **look)


def _draw_path(axes: Axes, points: list[tuple[float, float]]) -> None:
    if points:
        axes.plot(*zip(*points, strict=True), color="#1c9a4b", linewidth=4.0, alpha=0.6, label="plan")
        axes.plot(*points[-1], "*", color=CAUTION, markersize=14, linestyle="none", label="end of the plan")


def _draw_robot(axes: Axes, x: float, y: float, yaw: float) -> None:
    axes.add_patch(Circle((x, y), RADIUS, facecolor=PATH, edgecolor="black", alpha=0.8, label="robot"))
    nose = x + 2 * RADIUS * math.cos(yaw), y + 2 * RADIUS * math.sin(yaw)
    axes.plot([x, nose[0]], [y, nose[1]], color="black", linewidth=1.5)


def _points(path: Any) -> Iterable[tuple[float, float]]:
    if hasattr(path, "poses"):
        return ((pose.pose.position.x, pose.pose.position.y) for pose in path.poses)
    return ((float(point[0]), float(point[1])) for point in path)
