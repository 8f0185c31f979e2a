"""`plot_graph`: the nodes and connections of a run, and missing connections with their reasons."""

from __future__ import annotations

import textwrap
from typing import Any

from matplotlib.axes import Axes
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch
from matplotlib.path import Path

from sim.evidence import Recording
from sim.view.graph_diagram import GraphDiagram, graph_diagram
from sim.view.graph_layout import FONT, LINE, PlacedArrow, PlacedBox, lay_out
from sim.view.plot import FAILURE, MUTED, PATH, SOLID, WARNING, Plot, plot

MARGIN = 0.12  # inches
MIN_WIDTH, MAX_WIDTH = 3.6, 8.0  # inches
CHARACTERS = 15  # of a reason, per inch
# Fill, edge and text color. Kinds differ in shape and second line, too.
STYLES = {
    "node": ("#d3e4f5", PATH, "black"),
    "course": ("#e9ecef", SOLID, "black"),
    "topic": ("white", PATH, "black"),
    "service": ("white", SOLID, "black"),
    "action": ("white", SOLID, "black"),
    "rest": ("white", "#d5dade", SOLID),
}


class GraphPlot(Plot):
    """A plot of a graph."""

    words = ""

    @property
    def description(self) -> str:
        """A line for each topic, service and action, then the missing connections with their reasons."""
        return self.words


def plot_graph(recording: Recording) -> GraphPlot:
    """Draw nodes, topics with their rates, services and actions of a run, and the connections between them.

    A missing connection is red, dashed and numbered, and its reason is below the graph. Gray boxes list what
    a node offers and no node uses. The nodes of the world and of an exercise are gray, too.

    The `description` of the returned plot has the same as text.
    """
    return draw_diagram(graph_diagram(recording), recording.failure)


def draw_diagram(diagram: GraphDiagram, failure: str = "") -> GraphPlot:
    """Plot boxes and arrows; below them the reasons for missing connections, and the failure of the run."""
    layout = lay_out(diagram, MAX_WIDTH)
    width, height = max(layout.width + 2 * MARGIN, MIN_WIDTH), layout.height
    lines = _wrapped(diagram, width, failure)
    below = (len(lines) + 1) * LINE if lines else 0.0
    figure, axes = _canvas(width, height + 2 * MARGIN, below)
    for arrow in layout.arrows:
        _draw_arrow(axes, arrow)
    for box in layout.boxes:
        _draw_box(axes, box)
    for line, style in lines:
        height += LINE
        axes.text(0, height, line, fontsize=FONT, va="center", parse_math=False, **style)
    figure.words = "\n".join(filter(None, (diagram.text, failure)))
    return figure


def _canvas(width: float, height: float, below: float) -> tuple[GraphPlot, Axes]:
    """A figure with coordinates in inches, y down, without visible axes."""
    figure, axes = plot(width, height + below, GraphPlot)
    figure.set_layout_engine("none")
    axes.set_position((0, 0, 1, 1))
    axes.set(xlim=(-MARGIN, width - MARGIN), ylim=(height + below - MARGIN, -MARGIN))
    axes.set_axis_off()
    return figure, axes


def _wrapped(diagram: GraphDiagram, width: float, failure: str) -> list[tuple[str, dict[str, Any]]]:
    """The lines below the graph, each with its text properties."""
    red, gray, most = {"color": FAILURE}, {"color": SOLID}, int(width * CHARACTERS)
    lines, drawn = [], {arrow.gap for arrow in diagram.arrows.values()}
    for number, reason in enumerate(diagram.reasons, 1):
        text = f"{number}  {reason}" if number in drawn else reason
        lines += [(line, red) for line in textwrap.wrap(text, most, subsequent_indent="    ")]
    lines += [(line, gray) for line in textwrap.wrap(diagram.omitted, most)]
    return lines + [(line, {"color": FAILURE}) for line in textwrap.wrap(failure, most)]


def _draw_box(axes: Axes, placed: PlacedBox) -> None:
    (box, (x, y), (width, height)) = placed
    fill, edge, ink = STYLES["course" if box.from_course else box.kind]
    round_ = min(height, width) / 2 if box.kind == "node" else 0.06 if box.kind == "action" else 0.0
    style = f"round,pad=0,rounding_size={round_}" if round_ else "square,pad=0"
    corner = x - width / 2, y - height / 2
    look: dict[str, Any] = {"facecolor": fill, "edgecolor": edge}
    look["linewidth"] = 2.2 if box.kind == "service" else 1.1
    axes.add_patch(FancyBboxPatch(corner, width, height, boxstyle=style, **look))
    first = y - LINE * (len(box.lines) - 1) / 2
    for number, line in enumerate(box.lines):
        look = {"ha": "center", "va": "center", "fontsize": FONT, "parse_math": False}
        look["fontweight"] = "bold" if box.kind == "node" else "normal"
        axes.text(x, first + number * LINE, line, color=SOLID if number else ink, **look)


def _draw_arrow(axes: Axes, placed: PlacedArrow) -> None:
    arrow, points, middle = placed
    muted = arrow.end[0] == "rest"
    color = WARNING if arrow.gap else MUTED if muted else SOLID
    look: dict[str, Any] = {"linewidth": 1.8, "linestyle": (0, (4, 2))} if arrow.gap else {"linewidth": 1.0}
    look |= {"arrowstyle": "-" if muted else "-|>,head_length=0.35,head_width=0.18", "color": color}
    look |= {"mutation_scale": 14, "zorder": 0.5, "shrinkA": 0, "shrinkB": 0}
    curves = Path(points, [Path.MOVETO, *[Path.CURVE4] * (len(points) - 1)])
    axes.add_patch(FancyArrowPatch(path=curves, **look))
    if arrow.gap:
        disc = {"boxstyle": "circle,pad=0.15", "facecolor": "white", "edgecolor": WARNING}
        look = {"ha": "center", "va": "center", "fontsize": FONT - 1, "fontweight": "bold"}
        axes.text(*middle, str(arrow.gap), color=WARNING, bbox=disc, **look)
