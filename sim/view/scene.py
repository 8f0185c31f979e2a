"""The world from above, and the robot's way through it: metres, map frame."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.patches import Circle, Polygon

from sim.recording import Pose, Recording
from sim.view.figure import CAUTION, MUTED, PATH, SOLID, WARNING, Plot, plot
from sim.world import RobotModel, World

Point = tuple[float, float]
MARGIN = 0.2  # metres around what is shown
NO_ROBOT = 'this run has no robot to draw: give run() a world, such as world="yard"'


def plot_path(recording: Recording) -> Plot:
    """The robot's path over its world, with start, goal and contacts; a machine's bodies at start and end.

    Raises ValueError for a run without a robot or machine.
    """
    figure, axes = scene(recording)
    poses, end = recording.path, f"end, {_moved(recording)[-1].stamp:.3g} s"
    _bodies(axes, recording, end)
    if poses:
        axes.plot([p.x for p in poses], [p.y for p in poses], color=PATH, linewidth=1.8, label="path")
        _arrow(axes, poses[0], "start", MUTED)
        _arrow(axes, poses[-1], end, PATH)
    if recording.contacts:
        touched = np.array([(contact.x, contact.y) for contact in recording.contacts])
        axes.plot(*touched.T, "x", color=WARNING, markersize=9, markeredgewidth=2.5, label="contact")
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
    return figure


def scene(recording: Recording) -> tuple[Plot, Axes]:
    """The world of a run without what moves in it; axes that hold the world and the whole path.

    Raises ValueError for a run without a robot or machine.
    """
    if recording.world is None or not _moved(recording):
        raise ValueError(NO_ROBOT)
    world: World = recording.world
    figure, axes = plot(6.4, 4.8)
    draw_world(axes, world)
    xs = [pose.x for pose in recording.path] + [world.bounds[0], world.bounds[2]]
    ys = [pose.y for pose in recording.path] + [world.bounds[1], world.bounds[3]]
    axes.set(
        xlim=(min(xs) - MARGIN, max(xs) + MARGIN),
        ylim=(min(ys) - MARGIN, max(ys) + MARGIN),
        aspect="equal",
        xlabel="x (m)",
        ylabel="y (m)",
        title=f"{world.name}, seen from above" if recording.path else world.name,
    )
    axes.grid(color="#e6e9ec", linewidth=0.6)
    axes.set_axisbelow(True)
    return figure, axes


def draw_world(axes: Axes, world: World) -> None:
    """Walls, boxes, pillars and the goal."""
    axes.add_collection(LineCollection(world.walls, colors=SOLID, linewidths=2.5))
    for box in world.boxes:
        axes.add_patch(Polygon(box.corners(), facecolor=MUTED, edgecolor=SOLID))
    for pillar in world.circles:
        axes.add_patch(Circle((pillar.x, pillar.y), pillar.radius, facecolor=MUTED, edgecolor=SOLID))
    if world.goal:
        axes.plot(*world.goal, "*", color=CAUTION, markersize=15, label="goal", linestyle="none")


def _moved(recording: Recording) -> list[Pose]:
    """The poses of the robot, or of a machine's first body; none before the run has begun."""
    return recording.path or next(iter(recording.tracks.values()), [])


def _bodies(axes: Axes, recording: Recording, end: str) -> None:
    """Everything that moves beside the robot, where it was at first and at last."""
    labels = {0: "start", -1: end} if not recording.path else {}
    for body in recording.world.bodies:
        poses = recording.tracks.get(body.name, [])
        for index, colour in ((0, MUTED), (-1, PATH)) if poses else ():
            style = {
                "facecolor": colour,
                "alpha": 0.45,
                "edgecolor": colour,
                "label": labels.pop(index, None),
            }
            place = poses[index]
            if body.radius:
                axes.add_patch(Circle((place.x, place.y), body.radius, **style))
            else:
                axes.add_patch(Polygon(_placed(body.outline, place), **style))


def _placed(outline: Sequence[Point], pose: Pose) -> list[Point]:
    """The corners of a body's outline in the map frame."""
    c, s = math.cos(pose.yaw), math.sin(pose.yaw)
    return [(pose.x + c * u - s * v, pose.y + s * u + c * v) for u, v in outline]


def _arrow(axes: Axes, pose: Pose, label: str, colour: str) -> None:
    """The robot's outline, and which way it looks."""
    radius = RobotModel().radius
    nose = (pose.x + radius * math.cos(pose.yaw), pose.y + radius * math.sin(pose.yaw))
    axes.add_patch(
        Circle((pose.x, pose.y), radius, facecolor=colour, alpha=0.45, edgecolor=colour, label=label)
    )
    axes.plot([pose.x, nose[0]], [pose.y, nose[1]], color="black", linewidth=1.5)
