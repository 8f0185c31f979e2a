"""The graph of a run: who sends what to whom, and which connection doesn't come about, and why."""

from __future__ import annotations

import functools
import textwrap
from collections.abc import Callable, Mapping
from itertools import pairwise

from matplotlib.axes import Axes
from matplotlib.font_manager import FontProperties
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch
from matplotlib.path import Path
from matplotlib.textpath import TextPath

from sim.evidence import Recording
from sim.view.figure import MUTED, PATH, SOLID, WARNING, Plot, plot
from sim.view.layered import Layout, Point, layered
from sim.view.wiring import Arrow, Box, Key, Wiring, columns, wiring

FONT = 8.0  # points
LINE, PAD, MARGIN = 0.145, 0.09, 0.12  # inches: a line of text, around it, around all
INCH = 72  # points
NARROWEST, WIDEST = 3.6, 8.0  # inches
CHARACTERS = 15  # of a reason, in an inch
SPREAD = 0.8  # of the side of a box, over which its arrows are spread
# Fill, edge and colour of the text. Kinds differ in form and second line, too.
LOOKS = {
    "node": ("#d3e4f5", PATH, "black"),
    "ours": ("#e9ecef", SOLID, "black"),
    "topic": ("white", PATH, "black"),
    "service": ("white", SOLID, "black"),
    "action": ("white", SOLID, "black"),
    "rest": ("white", "#d5dade", SOLID),
}


class GraphPlot(Plot):
    """A picture of a graph."""

    text = ""

    @property
    def words(self) -> str:
        """The same in words: a line for each topic, service and action, then what is missing and why."""
        return self.text


def plot_graph(recording: Recording) -> GraphPlot:
    """Draw nodes, topics with their rates, services and actions of a run, and the connections between them.

    A connection that doesn't come about is red, broken and numbered, and its reason stands below. Grey boxes
    hold what a node offers and nobody takes. The nodes of the world and of an exercise are grey, too.

    The `words` of what this returns say the same.
    """
    return drawn(wiring(recording))


def drawn(shown: Wiring) -> GraphPlot:
    """The picture of boxes and arrows, with the reasons for what is missing below."""
    sizes = {key: _size(box) for key, box in columns(shown)}
    layout = layered(sizes, shown.arrows)
    down = layout.along > WIDEST
    if down:  # the layers lie below each other, as there are many
        sizes = {key: (height, width) for key, (width, height) in sizes.items()}
        layout = layered(sizes, shown.arrows)
    turn = _turned if down else _as_it_is
    width, height = turn((layout.along, layout.across))
    width = max(width + 2 * MARGIN, NARROWEST)
    reasons = _wrapped(shown, width)
    below = (len(reasons) + 1) * LINE if reasons else 0.0
    figure, axes = _canvas(width, height + 2 * MARGIN, below)
    ways = _ways(layout, sizes)
    for ends, arrow in shown.arrows.items():
        _draw_arrow(axes, arrow, ways[ends], turn)
    for key, box in shown.boxes.items():
        _draw_box(axes, box, turn(layout.centres[key]), turn(sizes[key]))
    for line in reasons:
        height += LINE
        axes.text(0, height, line, fontsize=FONT, color=WARNING, va="center", fontweight="bold")
    figure.text = shown.text
    return figure


def _as_it_is(point: Point) -> Point:
    return point


def _turned(point: Point) -> Point:
    return point[::-1]


def _canvas(width: float, height: float, below: float) -> tuple[GraphPlot, Axes]:
    """A figure whose coordinates are inches, y down, and no axes are drawn."""
    figure, axes = plot(width, height + below, GraphPlot)
    figure.set_layout_engine("none")
    axes.set_position((0, 0, 1, 1))
    axes.set(xlim=(-MARGIN, width - MARGIN), ylim=(height + below - MARGIN, -MARGIN))
    axes.set_axis_off()
    return figure, axes


def _wrapped(shown: Wiring, width: float) -> list[str]:
    lines = []
    for number, reason in enumerate(shown.reasons, 1):
        lines += textwrap.wrap(f"{number}  {reason}", int(width * CHARACTERS), subsequent_indent="    ")
    return lines


@functools.cache
def _text_width(text: str) -> float:
    return TextPath((0, 0), text, size=FONT, prop=FontProperties(weight="bold")).get_extents().width / INCH


def _size(box: Box) -> Point:
    return max(map(_text_width, box.lines)) + 2 * PAD, LINE * len(box.lines) + PAD


def _draw_box(axes: Axes, box: Box, centre: Point, size: Point) -> None:
    fill, edge, ink = LOOKS["ours" if box.ours else box.kind]
    (x, y), (width, height) = centre, size
    round_ = min(height, width) / 2 if box.kind == "node" else 0.06 if box.kind == "action" else 0.0
    style = f"round,pad=0,rounding_size={round_}" if round_ else "square,pad=0"
    corner = x - width / 2, y - height / 2
    look = {"facecolor": fill, "edgecolor": edge, "linewidth": 2.2 if box.kind == "service" else 1.1}
    axes.add_patch(FancyBboxPatch(corner, width, height, boxstyle=style, **look))
    first = y - LINE * (len(box.lines) - 1) / 2
    for number, line in enumerate(box.lines):
        look = {"ha": "center", "va": "center", "fontsize": FONT}
        look["fontweight"] = "bold" if box.kind == "node" else "normal"
        axes.text(x, first + number * LINE, line, color=SOLID if number else ink, **look)


def _draw_arrow(axes: Axes, arrow: Arrow, way: list[Point], turn: Callable[[Point], Point]) -> None:
    muted = arrow.end[0] == "rest"
    colour = WARNING if arrow.gap else MUTED if muted else SOLID
    look = {"linewidth": 1.8, "linestyle": (0, (4, 2))} if arrow.gap else {"linewidth": 1.0}
    look |= {"arrowstyle": "-" if muted else "-|>,head_length=0.35,head_width=0.18", "color": colour}
    look |= {"mutation_scale": 14, "zorder": 0.5, "shrinkA": 0, "shrinkB": 0}
    axes.add_patch(FancyArrowPatch(path=_curve(way, turn), **look))
    if arrow.gap:
        (x, y), (u, v) = map(turn, way[len(way) // 2 - 1 : len(way) // 2 + 1])
        disc = {"boxstyle": "circle,pad=0.15", "facecolor": "white", "edgecolor": WARNING}
        look = {"ha": "center", "va": "center", "fontsize": FONT - 1, "fontweight": "bold"}
        axes.text((x + u) / 2, (y + v) / 2, str(arrow.gap), color=WARNING, bbox=disc, **look)


def _ways(layout: Layout, sizes: Mapping[Key, Point]) -> dict[tuple[Key, Key], list[Point]]:
    """The ways of all arrows, from the side of one box to the side of the other.

    Those that share a side are spread over it, in the order of where they come from or go to.
    """
    ways = {}
    sides: dict[tuple[Key, bool], list[tuple[float, int, tuple[Key, Key]]]] = {}
    for ends, way in layout.ways.items():
        begin, end = (layout.centres[key] for key in ends)
        inner = way[1:-1]
        if len(inner) > 1 and abs(inner[0][0] - begin[0]) > abs(inner[-1][0] - begin[0]):
            inner = inner[::-1]  # the layout has turned it round
        ways[ends] = way = [begin, *inner, end]
        for place, key in ((0, ends[0]), (-1, ends[1])):
            neighbour = way[1 if place == 0 else -2]
            right = neighbour[0] > layout.centres[key][0]
            sides.setdefault((key, right), []).append((neighbour[1], place, ends))
    for (key, right), arrows in sides.items():
        (x, y), (width, height) = layout.centres[key], sizes[key]
        for number, (_, place, ends) in enumerate(sorted(arrows)):
            share = (number + 0.5) / len(arrows) - 0.5
            ways[ends][place] = x + (width if right else -width) / 2, y + SPREAD * height * share
    return ways


def _curve(points: list[Point], turn: Callable[[Point], Point]) -> Path:
    """Through all points, straight along the layers at each."""
    vertices, codes = [points[0]], [Path.MOVETO]
    for (x, y), (u, v) in pairwise(points):
        middle = (x + u) / 2
        vertices += [(middle, y), (middle, v), (u, v)]
        codes += 3 * [Path.CURVE4]
    return Path([turn(vertex) for vertex in vertices], codes)
