"""A run that is played again in a page: one piece of HTML without any id, address or other file.

It holds the run as inert data and as a picture, and a constant script that makes a player out of them.
Where scripts don't run, the picture stays; to a page cleaned of scripts, `PLAYER_SCRIPT` can be added.
"""

from __future__ import annotations

import base64
import html
import math
from typing import Any

from sim.evidence import Recording
from sim.view.figure import Plot, small_png
from sim.view.packing import pack, run_end
from sim.view.scene import plot_path
from sim.view.scripts import script
from sim.view.timeline import plot_topics

PLAYER_SCRIPT = f'(() => {{\n"use strict";\n{script("replay.js")}\n}})();'
"""Turns every replay of the page that is not a player yet into one. It holds no data."""


class Replay:
    """A run as a page shows it; see `replay`."""

    def __init__(self, recording: Recording, speed: float) -> None:
        self._data = pack(recording, speed)
        self._picture = base64.b64encode(small_png(_still(recording))).decode()
        self._words = f"Replay of {run_end(recording):g} s"

    @property
    def html(self) -> str:
        """The piece of HTML, for a page of one's own."""
        image = f'<img src="data:image/png;base64,{self._picture}" alt="{html.escape(self._words)}">'
        return (
            f'<div class="ros2-replay" data-replay="{self._data}">{image}</div>'
            f"<script>{PLAYER_SCRIPT}</script>"
        )

    def _repr_html_(self) -> str:
        return self.html

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        return {"text/html": self.html, "text/plain": repr(self)}

    def __repr__(self) -> str:
        return f"<{self._words}: {len(self.html) / 1024:.0f} KiB>"


def replay(recording: Recording, *, speed: float = 1.0) -> Replay:
    """The run as a player with a scrub bar; it stays in the notebook and in pages made from it.

    speed: simulated seconds per second of playing, to begin with.
    Without a world there is a timeline of the topics. Raises ValueError for a speed that isn't above 0.
    """
    if not (speed > 0 and math.isfinite(speed)):
        raise ValueError(f"speed must be a number above 0; it is {speed!r}")
    return Replay(recording, float(speed))


def _still(recording: Recording) -> Plot:
    return plot_path(recording) if recording.world is not None else plot_topics(recording)
