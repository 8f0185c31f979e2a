"""A small SVG of a run: its world with paths, or its graph. Equal runs give equal bytes.

The colors are legible on light and on dark pages. The SVG has no scripts, fonts or addresses.
"""

from __future__ import annotations

import html
import math
from collections.abc import Iterable, Sequence
from typing import Any

from sim.evidence import Pose, Recording
from sim.view.body_tracks import body_tracks, extent_radius
from sim.view.graph_data import graph_data
from sim.view.plot import KINDS, ROBOTS, TURTLES
from sim.view.strokes import visible_strokes
from sim.world import Body, World
from sim.world.obstacles import placed

WIDTH, HEIGHT, MARGIN = 320, 180, 12  # px
WALL, SOLID, GROUND, GAP = "#8a95a1", "#a9b3bd", "rgba(128,128,128,.12)", "#d9544f"
ROBOT = 7.0  # px, the least radius of a robot
WIDE = 100.0  # inches: graphs are drawn from left to right
STEP = 2.0  # px between the points of a path
Point = tuple[float, float]


def thumbnail(recording: Recording, drawing: str = "world") -> str:
    """The SVG. drawing: "world" or "graph"; raises ValueError for another one."""
    draw = {"world": _world, "graph": _graph}.get(drawing)
    if draw is None:
        raise ValueError(f'drawing must be "world" or "graph"; it is {drawing!r}')
    ground = f'<rect width="{WIDTH}" height="{HEIGHT}" fill="{GROUND}"/>'
    lines = "\n".join([ground, *draw(recording)])
    size = f'viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {size}>\n{lines}\n</svg>\n'


class _Fit:
    """Converts meters to pixels, so that an area fills the picture without being distorted."""

    def __init__(self, left: float, bottom: float, right: float, top: float) -> None:
        self.scale = min((WIDTH - 2 * MARGIN) / (right - left), (HEIGHT - 2 * MARGIN) / (top - bottom))
        self._x = WIDTH / 2 - self.scale * (left + right) / 2
        self._y = HEIGHT / 2 + self.scale * (bottom + top) / 2

    def __call__(self, point: Sequence[float]) -> Point:
        return self._x + self.scale * point[0], self._y - self.scale * point[1]

    def path(self, points: Iterable[Sequence[float]], end: str = "") -> str:
        """The `d` of a line through the points; points close to the one before are left out."""
        kept: list[Point] = []
        for point in map(self, points):
            if not kept or math.dist(point, kept[-1]) >= STEP:
                kept.append(point)
        return "M" + " ".join(f"{_short(x)},{_short(y)}" for x, y in kept) + end


def _world(recording: Recording) -> Iterable[str]:
    world, tracks = recording.world, body_tracks(recording)
    assert world is not None  # its picture is asked for
    fit = _Fit(*_area(world, recording, tracks))
    walls = "".join(fit.path(ends) for ends in world.walls)
    yield _line(walls, WALL, 3)
    for box in world.boxes:
        yield _area_of(fit.path(box.corners(), "z"), SOLID)
    for pillar in world.circles:
        yield _disc(fit((pillar.x, pillar.y)), pillar.radius * fit.scale, SOLID)
    if world.goal:
        yield _star(fit(world.goal))
    if recording.drawing is not None:
        for color, _, points in visible_strokes(recording.drawing)["strokes"]:
            yield _line(fit.path(points), f"#{color:06x}", 2)
    if recording.tip:
        yield _line(fit.path((pose.x, pose.y) for pose in recording.tip), ROBOTS[0], 2.5)
    yield from _bodies(recording, tracks, fit)


def _area(
    world: World, recording: Recording, tracks: Sequence[Sequence[Pose]]
) -> tuple[float, float, float, float]:
    """The bounds of the world; of one without walls, what the bodies and their paths cover."""
    left, bottom, right, top = world.bounds
    if world.walls:
        return left, bottom, right, top
    reach = 0.0 if recording.tip else max(map(extent_radius, recording.bodies), default=0.0)
    points = [pose[1:3] for track in [*tracks, recording.tip] for pose in track]
    points += [world.goal] if world.goal else []
    for box in world.boxes:
        points += box.corners()
    xs, ys = zip(*points, strict=True)
    pad = reach + 0.2
    return min(xs) - pad, min(ys) - pad, max(xs) + pad, max(ys) + pad


def _bodies(recording: Recording, tracks: Sequence[Sequence[Pose]], fit: _Fit) -> Iterable[str]:
    """The paths of robots, and all bodies at their last poses."""
    kinds = [body.kind for body in recording.bodies]
    for index, (body, track) in enumerate(zip(recording.bodies, tracks, strict=True)):
        color = KINDS.get(body.kind, SOLID)
        if body.kind == "turtle":
            color = TURTLES[kinds[:index].count("turtle") % len(TURTLES)]
        if body.kind == "robot":
            color = ROBOTS[kinds[:index].count("robot") % len(ROBOTS)]
            yield _line(fit.path(pose[1:3] for pose in track), color, 2.5)
        yield from _body(body, track[-1], color, fit)


def _body(body: Body, pose: Pose, color: str, fit: _Fit) -> Iterable[str]:
    if body.outline:
        yield _area_of(fit.path(placed(body.outline, *pose[1:]), "z"), color)
        return
    x, y = fit(pose[1:3])
    radius = max(body.radius * fit.scale, ROBOT if body.kind == "robot" else 3.0)
    yield _disc((x, y), radius, color)
    if body.kind == "robot":
        nose = x + 0.8 * radius * math.cos(pose.yaw), y - 0.8 * radius * math.sin(pose.yaw)
        yield _line(f"M{_short(x)},{_short(y)} {_short(nose[0])},{_short(nose[1])}", "#fff", 2)


def _graph(recording: Recording) -> Iterable[str]:
    data = graph_data(recording, counted=False, max_width=WIDE)
    assert data is not None  # the run has nodes
    scale = min((WIDTH - 2 * MARGIN) / data["width"], (HEIGHT - 2 * MARGIN) / data["height"], 1.0)
    right, down = (WIDTH - scale * data["width"]) / 2, (HEIGHT - scale * data["height"]) / 2
    yield f'<g transform="translate({right:.1f} {down:.1f}) scale({scale:.3f})">'
    for arrow in data["arrows"]:
        first, second, *rest = _pairs(arrow["points"])
        curve = f"M{first} C{' '.join([second, *rest])}"
        color = GAP if arrow["gap"] else WALL
        yield _line(curve, color, 3, "8 5" if arrow["gap"] else "")
    for box in data["boxes"]:
        yield from _box(box)
    yield "</g>"


def _box(box: dict[str, Any]) -> Iterable[str]:
    """A node is round and blue, the course's is gray; a topic has corners."""
    left, top, width, height = box["place"]
    node, rest = box["kind"] in ("node", "course"), box["kind"] == "rest"
    edge = ROBOTS[0] if box["kind"] == "node" else SOLID if rest else WALL
    fill = {"node": "rgba(47,134,217,.35)", "course": "rgba(128,128,128,.35)"}.get(box["kind"], "#fff")
    radius = height // 2 if node else 3
    yield (
        f'<rect x="{left}" y="{top}" width="{width}" height="{height}" rx="{radius}" '
        f'fill="{fill}" stroke="{edge}" stroke-width="1.5"/>'
    )
    ink = "#3a4550" if not node else "#5d97c9" if box["kind"] == "node" else WALL
    words = html.escape(box["lines"][0])
    yield (
        f'<text x="{left + width // 2}" y="{top + height // 2 + 4}" text-anchor="middle" fill="{ink}" '
        f'font-family="sans-serif" font-weight="bold" font-size="12">{words}</text>'
    )


def _pairs(values: Sequence[float]) -> list[str]:
    return [f"{x},{y}" for x, y in zip(values[::2], values[1::2], strict=True)]


def _line(path: str, color: str, width: float, dashes: str = "") -> str:
    dashed = f' stroke-dasharray="{dashes}"' if dashes else ""
    look = f'stroke-width="{width}" stroke-linecap="round" stroke-linejoin="round"'
    return f'<path d="{path}" fill="none" stroke="{color}" {look}{dashed}/>'


def _area_of(path: str, fill: str) -> str:
    return f'<path d="{path}" fill="{fill}" stroke="{WALL}"/>'


def _disc(center: Point, radius: float, fill: str) -> str:
    x, y = map(_short, center)
    return f'<circle cx="{x}" cy="{y}" r="{_short(radius)}" fill="{fill}"/>'


def _star(center: Point) -> str:
    angles = [math.pi * (tip / 5 - 0.5) for tip in range(10)]
    points = [
        (center[0] + reach * math.cos(angle), center[1] + reach * math.sin(angle))
        for angle, reach in zip(angles, [13.0, 5.5] * 5, strict=True)
    ]
    path = " ".join(f"{_short(x)},{_short(y)}" for x, y in points)
    return f'<path d="M{path}z" fill="#efb021" stroke="#9a6a00"/>'


def _short(value: float) -> str:
    """A number of pixels, to a half."""
    return f"{round(2 * value) / 2:g}"
