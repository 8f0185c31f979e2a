"""The data of interactive plots over simulated time: panels of series, rows of ticks, and what happened when.

`checkPlot` in web/plots.js parses it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

from sim.evidence import Recording
from sim.view.replay_data import event_marks, mark_rows, run_end, run_key
from sim.view.strokes import thinned

VERSION = 1
POINTS = 2_000  # of a series
TICKS = 1_000  # of a row
FAILURE = 500  # characters
FEW = 60  # of so many points each has a marker


def series(
    name: str,
    moments: Sequence[float],
    values: Sequence[float],
    *,
    style: str = "line",
    color: str | int = 0,
) -> dict[str, Any]:
    """A series of a panel: a "line", a "step" line, or "points". NaN breaks a line; infinities are left out.

    color: the index of a robot's color, or "warning" or "caution".
    """
    points = thinned(list(zip(moments, values, strict=True)), POINTS)
    return {
        "name": name,
        "style": style,
        "color": color,
        "markers": style == "points" or len(points) <= FEW,
        "x": [round(moment, 4) for moment, _ in points],
        "y": [float(f"{value:.5g}") if math.isfinite(value) else None for _, value in points],
    }


def panel(
    unit: str, curves: Iterable[dict[str, Any]], levels: Sequence[tuple[float, str, str]] = ()
) -> dict[str, Any]:
    """Series with one vertical axis. levels: values, names and colors of horizontal lines."""
    return {"unit": unit, "series": list(curves), "levels": [list(level) for level in levels]}


def row(name: str, moments: Sequence[float], color: str | int = 0) -> dict[str, Any]:
    """A row of ticks; a name may have several lines."""
    return {
        "name": name,
        "color": color,
        "x": [round(moment, 4) for moment in thinned(list(moments), TICKS)],
    }


def plot_data(
    recording: Recording,
    title: str,
    *,
    panels: Sequence[dict[str, Any]] = (),
    rows: Sequence[dict[str, Any]] = (),
) -> dict[str, Any]:
    """The data of a plot: panels one below the other, or rows."""
    end = run_end(recording) or recording.seconds or 1.0
    over = (end, "end", "the run ended.", None)
    return {
        "version": VERSION,
        "run": run_key(recording),
        "title": title,
        "failure": recording.failure[:FAILURE],
        "begin": recording.begin,
        "end": end,
        "panels": list(panels),
        "rows": list(rows),
        "marks": mark_rows(event_marks(recording), over),
    }
