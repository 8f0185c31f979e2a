"""Base class and helpers of all plots. They don't use matplotlib's global state, which is the student's."""

from __future__ import annotations

import io
import textwrap
from typing import Any, TypeVar, overload

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from sim.evidence import Recording
from sim.view.interactive import player_html, plot_html

PATH, SOLID, WARNING, MUTED, CAUTION = "#1f6fb4", "#5b6470", "#d64541", "#9aa3ad", "#e8a33d"
ROBOTS = (PATH, "#8a4fc0", "#158a6b", "#c2477f")  # the first robot, and further ones
KINDS = {"box": "#d9b991", "person": "#f08a5d", "link": "#3d9aa1", "cart": "#7d8fa3"}  # of bodies
TURTLES = ("#7bc96f", "#f2b84b", "#e8807f", "#d9a5e8")  # on a pond's background
STYLES, MARKERS = ("-", "--", ":", "-."), (".", "x", "+", "v")  # lines differ in more than color
GRID = "#e6e9ec"
FAILURE = "#b3261e"  # 6.5 to 1 on white
CHARACTERS, LINE = 14, 0.18  # of a note: per inch, and inches
DPI = 100
COLORS = 48  # of a small picture


class Plot(Figure):
    """A figure that Jupyter displays without pyplot, with a description as alt text."""

    failure = ""  # of the run that it shows
    _plot: dict[str, Any] | None = None
    _path = ""
    _artists = 0  # in the axes, when the interactive picture was made

    def offer(self, *, plot: dict[str, Any] | None = None, path: str = "") -> None:
        """Let Jupyter show an interactive plot or path instead, unless more is drawn into the axes.

        plot: from `plot_data`. path: from `pack_path`.
        """
        self._plot, self._path, self._artists = plot, path, self._count_artists()

    def _count_artists(self) -> int:
        return sum(len(axes.get_children()) for axes in self.axes)

    @property
    def description(self) -> str:
        """The title, the axes, the entries of the legend or the rows, and the failure of the run."""
        (axes,) = self.axes
        _, named = axes.get_legend_handles_labels()
        rows = [label.get_text().replace("\n", " ") for label in axes.get_yticklabels()]
        named = named or [row for row in rows if row[-1:].isalpha() or " " in row]
        parts = (axes.get_title(), " over ".join(filter(None, (axes.get_ylabel(), axes.get_xlabel()))))
        return f"Plot: {'; '.join(filter(None, (*parts, ', '.join(named), self.failure)))}"

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        """The interactive plot, if there is one, with this figure for pages without scripts."""
        if (self._plot is None and not self._path) or self._count_artists() != self._artists:
            return {}  # then Jupyter shows the PNG
        return {"text/html": self._html(shared=True), "text/plain": repr(self)}

    @property
    def html(self) -> str:
        """The interactive plot as HTML, for use in other pages."""
        return self._html(shared=False)

    def _html(self, *, shared: bool) -> str:
        if self._path:
            return player_html(self._path, small_png(self), self.description, shared=shared)
        return plot_html(self._plot or {}, small_png(self), self.description, shared=shared)

    def _repr_png_(self) -> tuple[bytes, dict[str, str]]:
        return png(self), {"alt": self.description}


P = TypeVar("P", bound=Plot)


@overload
def plot(width: float, height: float) -> tuple[Plot, Axes]: ...
@overload
def plot(width: float, height: float, kind: type[P]) -> tuple[P, Axes]: ...
def plot(width: float, height: float, kind: type[Plot] = Plot) -> tuple[Plot, Axes]:
    """An empty figure with one pair of axes; sizes in inches, of 100 pixels each."""
    figure = kind(figsize=(width, height), dpi=DPI, layout="constrained", facecolor="white")
    FigureCanvasAgg(figure)
    return figure, figure.add_subplot()


def legend_beside(axes: Axes) -> None:
    """Add a legend to the right of the axes."""
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)


def note_failure(figure: P, recording: Recording) -> P:
    """Write the failure of a run below its plot, in red; nothing for a run that did not fail."""
    if recording.failure:
        figure.failure = recording.failure
        width = int(CHARACTERS * figure.get_size_inches()[0])
        text = textwrap.fill(recording.failure, width)
        figure.set_figheight(figure.get_figheight() + LINE * (text.count("\n") + 1))
        figure.supxlabel(text, x=0.01, ha="left", fontsize=9, color=FAILURE)
    return figure


def png(figure: Figure) -> bytes:
    """The figure as a PNG; equal figures give equal bytes."""
    buffer = io.BytesIO()
    # savefig gives the same result, but draws the figure an additional time.
    canvas: Any = FigureCanvasAgg(figure)
    canvas.print_png(buffer, metadata={"Software": None})
    return buffer.getvalue()


def small_png(figure: Plot) -> bytes:
    """The figure as a PNG with few colors, a quarter of the size."""
    figure.canvas.draw()
    image = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB")  # type: ignore[attr-defined]
    buffer = io.BytesIO()
    image.quantize(COLORS, dither=Image.Dither.NONE).save(buffer, "PNG", optimize=True)
    return buffer.getvalue()
