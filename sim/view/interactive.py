"""The HTML of replays and plots, which are interactive where scripts run, and a still picture elsewhere."""

from __future__ import annotations

import base64
import functools
import html
import json
from importlib.metadata import distribution
from pathlib import Path
from typing import Any

from sim.notebook import shared_scripts
from sim.view.javascript import packed, script
from sim.view.packing import deflated

PLAYER_SOURCE = script("replay.js")
PLAYER_SCRIPT = packed(PLAYER_SOURCE)
"""Turns every replay and path of the page into an interactive one. It contains no data."""

_UPLOT = "youplot"  # the package that brings uPlot; its Python code is not used


@functools.cache
def plot_script() -> str:
    """Turns every plot of the page into an interactive one. It contains no data."""
    return packed(plot_source())


def plot_source() -> str:
    """The script before it is packed: uPlot, and what draws plots with it."""
    style = f"const UPLOT_STYLE = {json.dumps(_vendored('uplot.min.css'))};"
    return "\n".join((_vendored("uplot.iife.min.js"), style, script("plots.js")))


def _vendored(name: str) -> str:
    path = distribution(_UPLOT).locate_file(f"youplot/vendor/{name}")
    return Path(str(path)).read_text(encoding="utf-8")


def plot_html(data: dict[str, Any], picture: bytes, description: str, *, shared: bool = False) -> str:
    """A plot as HTML. data: from `plot_data`. picture: a PNG, which remains where no script runs.

    shared: for the output of a cell; the script is left out if another output contains it.
    """
    image = _image(picture, description)
    script_ = plot_script() if _is_needed("ros2CoursePlots", shared) else "window.ros2CoursePlots?.()"
    return f'<div class="ros2-plot" data-plot="{deflated(data)}">{image}</div><script>{script_}</script>'


def player_html(data: str, picture: bytes, description: str, *, shared: bool = False) -> str:
    """A replay or a path as HTML. data: packed; the rest as in `plot_html`."""
    image = _image(picture, description)
    script_ = PLAYER_SCRIPT if _is_needed("ros2CourseReplays", shared) else "window.ros2CourseReplays?.()"
    return f'<div class="ros2-replay" data-replay="{data}">{image}</div><script>{script_}</script>'


def _is_needed(name: str, shared: bool) -> bool:
    return not shared or shared_scripts().is_needed(name)


def _image(picture: bytes, description: str) -> str:
    source = base64.b64encode(picture).decode()
    return f'<img src="data:image/png;base64,{source}" alt="{html.escape(description)}">'
