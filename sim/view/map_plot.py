"""`plot_map`: an occupancy grid, with a plan, points, the robot and its driven path; meters, map frame."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap

from sim.evidence import Pose, Recording
from sim.view.layer_kinds import grid_data, meters
from sim.view.packing import deflated, differences
from sim.view.path_plot import draw_body
from sim.view.plot import CAUTION, MUTED, PATH, WARNING, Plot, legend_beside, note_failure, plot
from sim.view.replay_data import POSES, VERSION, run_end, run_key
from sim.view.strokes import thinned
from sim.world import Body

UNKNOWN, FREE, OCCUPIED = "#b9c4c2", "#ffffff", "#23292f"
ROBOT = Body("robot", "robot", 0.1, ())
DOTS = (MUTED, WARNING)  # colors of points
MOST_DOTS, PLAN = 3000, 1000  # points on a page
# Values 0 to 100 as colors: free, then darker with higher cost, then occupied.
_COSTS = np.linspace((0.94, 0.97, 1.0, 1.0), (0.45, 0.62, 0.80, 1.0), 99)
_SHADES = ListedColormap([UNKNOWN, FREE, *_COSTS, OCCUPIED])
Points = Iterable[Sequence[float]]


def plot_map(
    grid: Any,
    path: Any = None,
    *,
    robot: Any = None,
    drive: Recording | None = None,
    points: Mapping[str, Points] | None = None,
) -> Plot:
    """Plot a nav_msgs/OccupancyGrid, whose origin must not be rotated.

    path: a nav_msgs/Path, or points (x, y).
    robot: its pose, (x, y, yaw) in meters and radians.
    drive: a run whose driven path is drawn too, with the robot at its end.
    points: (x, y) to mark, by what they are: the first ones gray, the next ones red.
    Raises ValueError for a map without cells.
    """
    info = grid.info
    if not info.width * info.height or len(grid.data) != info.width * info.height:
        raise ValueError(
            f"this map has no cells to draw: it is {info.width} by {info.height} cells, "
            f"and data holds {len(grid.data)} values"
        )
    plan = list(_points(path)) if path is not None else []
    marked = {name: [(x, y) for x, y, *_ in given] for name, given in (points or {}).items()}
    track = list(drive.path) if drive is not None else []
    if robot is not None:
        track.append(Pose(track[-1].stamp if track else 0.0, *robot))
    figure = _still(grid, plan, marked, track)
    data = {"version": VERSION, "run": "", "end": 0.0, "path": True, "speed": 1.0, "failure": ""}
    if drive is not None:
        data |= {"run": run_key(drive), "end": run_end(drive), "failure": drive.failure[:500]}
    data |= {"scans": [], "logs": [], "topics": [], "marks": [], "title": _title(grid)}
    data |= {"world": _world(grid, plan, bool(track)), **_motion(track)}
    data["layers"] = _layers(grid, plan, marked)
    figure.offer(path=deflated(data))
    return figure if drive is None else note_failure(figure, drive)


def _title(grid: Any) -> str:
    return f"{grid.info.width} by {grid.info.height} cells of {grid.info.resolution:.3g} m"


def _bounds(grid: Any) -> list[float]:
    """The left, lower, right and upper edge of a map."""
    info, corner = grid.info, grid.info.origin.position
    edges = corner.x + info.width * info.resolution, corner.y + info.height * info.resolution
    return meters(corner.x, corner.y, *edges)


def _world(grid: Any, plan: list[tuple[float, float]], has_robot: bool) -> dict[str, Any]:
    """A page's data of a world without walls: what is there is what the map has."""
    outline = {"name": ROBOT.name, "kind": ROBOT.kind, "radius": ROBOT.radius, "outline": []}
    return {
        **{"name": _title(grid), "bounds": _bounds(grid), "goal": meters(*plan[-1]) if plan else None},
        **{"walls": [], "boxes": [], "circles": [], "bodies": [outline] if has_robot else []},
        "lidar": {"start": 0.0, "step": 0.0, "far": 0.0},
    }


def _motion(track: Sequence[Pose]) -> dict[str, Any]:
    kept = thinned(track, POSES)
    stamps, *columns = ([round(1000 * pose[axis]) for pose in kept] for axis in range(4))
    return {"stamps": differences(stamps), "tracks": [[differences(c) for c in columns]] if kept else []}


def _layers(grid: Any, plan: list[tuple[float, float]], marked: Mapping[str, Any]) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = [{"kind": "map", "topic": "map", "data": grid_data(grid)}]
    if plan:
        found.append({"kind": "plan", "topic": "plan", "data": [meters(*p) for p in thinned(plan, PLAN)]})
    for number, (name, places) in enumerate(marked.items()):
        dots = [meters(*place) for place in thinned(places, MOST_DOTS)]
        data = {"color": number % len(DOTS), "places": dots}
        found.append({"kind": "points", "topic": name, "data": data})
    return [{"stamp": 0, **layer} for layer in found]


def _still(
    grid: Any, plan: list[tuple[float, float]], marked: Mapping[str, Any], track: Sequence[Pose]
) -> Plot:
    """The figure for pages without scripts."""
    figure, axes = plot(6.4, 4.8)
    _draw_cells(axes, grid)
    if plan:
        axes.plot(*zip(*plan, strict=True), color="#1c9a4b", linewidth=4.0, alpha=0.6, label="plan")
        axes.plot(*plan[-1], "*", color=CAUTION, markersize=14, linestyle="none", label="goal")
    for number, (name, places) in enumerate(marked.items()):
        if places:
            axes.plot(*zip(*places, strict=True), ".", color=DOTS[number % len(DOTS)], label=name)
    if len(track) > 1:
        axes.plot([pose.x for pose in track], [pose.y for pose in track], color=PATH, label="path")
    if track:
        draw_body(axes, ROBOT, track[-1], PATH, 0.9, "robot")
    if axes.get_legend_handles_labels()[0]:
        legend_beside(axes)
    axes.set(aspect="equal", xlabel="x (m)", ylabel="y (m)", title=_title(grid))
    return figure


def _draw_cells(axes: Axes, grid: Any) -> None:
    left, bottom, right, top = _bounds(grid)
    values = np.array(grid.data, dtype=np.int16).reshape(grid.info.height, grid.info.width)
    shades = np.clip(values, -1, 100) + 1
    look: dict[str, Any] = {"cmap": _SHADES, "vmin": 0, "vmax": 101, "interpolation": "nearest"}
    axes.imshow(shades, origin="lower", extent=(left, right, bottom, top), **look)


def _points(path: Any) -> Iterable[tuple[float, float]]:
    if hasattr(path, "poses"):
        return ((pose.pose.position.x, pose.pose.position.y) for pose in path.poses)
    return ((float(point[0]), float(point[1])) for point in path)
