"""`plot_path`: the world of a run and the paths of its moving bodies; meters, map frame."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.patches import Circle, Polygon

from sim.evidence import Pose, Recording
from sim.view.body_tracks import MAX_POSE_GAP, body_tracks, extent_radius
from sim.view.path_data import pack_path
from sim.view.plot import (
    CAUTION,
    GRID,
    KINDS,
    MUTED,
    ROBOTS,
    SOLID,
    STYLES,
    TURTLES,
    WARNING,
    Plot,
    legend_beside,
    note_failure,
    plot,
)
from sim.view.strokes import draw_ground, draw_strokes
from sim.world import Body, World
from sim.world.obstacles import placed

MARGIN = 0.2  # m


def plot_path(recording: Recording) -> Plot:
    """Plot the robot's path in its world, with start, goal and contacts.

    Paths of other robots and of an arm's tip are drawn too; boxes and links are drawn at their first and last
    poses, turtles at their last pose, with their lines.
    Raises ValueError for a run in which nothing moves.
    """
    figure, axes = world_figure(recording)
    bodies = recording.bodies
    robots = [body for body in bodies if body.kind == "robot"]
    if recording.drawing is not None:
        draw_strokes(axes, recording.drawing, recording.stamp)
    for body, track in zip(bodies, body_tracks(recording), strict=True):
        first = body is bodies[0]
        if body.kind == "turtle":
            if recording.stamp - track[-1].stamp < MAX_POSE_GAP:
                color = TURTLES[bodies.index(body) % len(TURTLES)]
                draw_body(axes, body, track[-1], color, 1.0, body.name)
            continue
        if body.kind == "robot":
            color = ROBOTS[robots.index(body) % len(ROBOTS)]
            path = [pose.x for pose in track], [pose.y for pose in track]
            style = STYLES[robots.index(body) % len(STYLES)]
            look: dict[str, Any] = {"color": color, "linestyle": style, "linewidth": 1.8}
            axes.plot(*path, **look, label="path" if first else body.name)
        else:
            color = KINDS.get(body.kind, MUTED)
        draw_body(axes, body, track[0], MUTED, 0.45, "start" if first else None)
        end = f"end, {track[-1].stamp:.3g} s" if first else None
        draw_body(axes, body, track[-1], color, 0.45 if body.kind == "robot" else 0.9, end)
    if recording.tip:
        path = [pose.x for pose in recording.tip], [pose.y for pose in recording.tip]
        axes.plot(*path, color=ROBOTS[0], linewidth=1.8, label="tip's path")
    if recording.contacts:
        points = np.array([(contact.x, contact.y) for contact in recording.contacts])
        axes.plot(*points.T, "x", color=WARNING, markersize=9, markeredgewidth=2.5, label="contact")
    legend_beside(axes)
    figure.offer(path=pack_path(recording))
    return note_failure(figure, recording)


def moving_tracks(recording: Recording) -> list[list[Pose]]:
    """The poses of each moving body of the run. Raises ValueError for a run in which nothing moves."""
    tracks = body_tracks(recording)
    if not tracks or not all(tracks):
        raise ValueError('this run has no robot to draw: give run() a world, such as world="yard"')
    return tracks


def world_figure(recording: Recording) -> tuple[Plot, Axes]:
    """A plot of the static world of a run; the axes' limits include the paths of all bodies.

    Raises ValueError for a run in which nothing moves.
    """
    world, tracks = recording.world, moving_tracks(recording)
    assert world is not None  # what moves is in it
    figure, axes = plot(6.4, 4.8)
    if recording.drawing is not None:
        draw_ground(axes, world, recording.drawing.ground)
    draw_world(axes, world)
    left, bottom, right, top = world.bounds
    for body, track in zip(recording.bodies, tracks, strict=True):
        radius = extent_radius(body)
        xs, ys = [pose.x for pose in track], [pose.y for pose in track]
        left, right = min(left, min(xs) - radius), max(right, max(xs) + radius)
        bottom, top = min(bottom, min(ys) - radius), max(top, max(ys) + radius)
    axes.set(
        xlim=(left - MARGIN, right + MARGIN),
        ylim=(bottom - MARGIN, top + MARGIN),
        aspect="equal",
        xlabel="x (m)",
        ylabel="y (m)",
        title=world.name if world.machine else f"{world.name}, seen from above",
    )
    axes.grid(color=GRID, linewidth=0.6)
    axes.set_axisbelow(True)
    return figure, axes


def draw_world(axes: Axes, world: World) -> None:
    """Draw walls, boxes, pillars, the goal and named locations."""
    axes.add_collection(LineCollection(world.walls, colors=SOLID, linewidths=2.5))
    for box in world.boxes:
        axes.add_patch(Polygon(box.corners(), facecolor=MUTED, edgecolor=SOLID))
    for pillar in world.circles:
        axes.add_patch(Circle((pillar.x, pillar.y), pillar.radius, facecolor=MUTED, edgecolor=SOLID))
    if world.goal:
        axes.plot(*world.goal, "*", color=CAUTION, markersize=15, label="goal", linestyle="none")
    for name, (x, y, *_) in world.places().items():
        axes.plot(x, y, "+", color=SOLID, markersize=7)
        axes.annotate(name, (x, y), (4, 3), textcoords="offset points", fontsize=7, color=SOLID)


def draw_body(axes: Axes, body: Body, pose: Pose, color: str, alpha: float, label: str | None) -> None:
    """Draw a moving body at a pose, with its heading if it is a robot."""
    look: dict[str, Any] = {"facecolor": color, "edgecolor": color, "alpha": alpha, "label": label}
    if body.outline:
        axes.add_patch(Polygon(placed(body.outline, *pose[1:]), **look))
    else:
        axes.add_patch(Circle(pose[1:3], body.radius, **look))
    if body.kind == "robot":
        nose = (pose.x + body.radius * math.cos(pose.yaw), pose.y + body.radius * math.sin(pose.yaw))
        axes.plot([pose.x, nose[0]], [pose.y, nose[1]], color="black", linewidth=1.5)
