"""Figures that stand on their own: none touches matplotlib's global state, which belongs to the student."""

from __future__ import annotations

import io

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

PATH, SOLID, WARNING, MUTED, CAUTION = "#1f6fb4", "#5b6470", "#d64541", "#9aa3ad", "#e8a33d"
ROBOTS = (PATH, "#8a4fc0", "#158a6b", "#c2477f")  # the first robot, and others
KINDS = {"box": "#d9b991", "link": "#3d9aa1", "cart": "#7d8fa3"}  # of bodies
GRID = "#e6e9ec"
DPI = 100


class Plot(Figure):
    """A figure that Jupyter shows without pyplot."""

    def _repr_png_(self) -> bytes:
        return png(self)


def plot(width: float, height: float) -> tuple[Plot, Axes]:
    """An empty figure with one pair of axes; sizes in inches, of 100 pixels each."""
    figure = Plot(figsize=(width, height), dpi=DPI, layout="constrained", facecolor="white")
    FigureCanvasAgg(figure)
    return figure, figure.add_subplot()


def legend_beside(axes: Axes) -> None:
    """Name what is drawn, to the right of the axes."""
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)


def png(figure: Figure) -> bytes:
    """The figure as a PNG; equal figures give equal bytes."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", metadata={"Software": None})
    return buffer.getvalue()
