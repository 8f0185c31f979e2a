"""The replay of a run as self-contained HTML, without ids, URLs or other files.

It contains the run as inert data, a picture, and a constant script that turns them into a player. Without
scripts the picture remains; `PLAYER_SCRIPT` can be added again to a page from which scripts were removed.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from sim.evidence import Recording
from sim.view.interactive import PLAYER_SCRIPT, player_html
from sim.view.path_plot import plot_path
from sim.view.plot import Plot, small_png
from sim.view.replay_data import Moment, pack, run_end
from sim.view.timeline_plots import plot_topics

__all__ = ["PLAYER_SCRIPT", "Replay", "replay"]


class Replay:
    """A replay for Jupyter; see `replay`. `above` is HTML to show above it."""

    above = ""
    shares_script = True  # with other outputs of the notebook; False for one that replaces an earlier output

    def __init__(
        self, recording: Recording, speed: float, moments: Sequence[Moment] = (), plays: bool = False
    ) -> None:
        self._data = pack(recording, speed, moments, plays)
        self._picture = small_png(_still(recording))
        self._title = f"Replay of {run_end(recording):g} s"

    @property
    def html(self) -> str:
        """The HTML, for use in other pages."""
        return self._html(shared=False)

    def _html(self, *, shared: bool) -> str:
        return self.above + player_html(self._data, self._picture, self._title, shared=shared)

    def _repr_html_(self) -> str:
        return self._html(shared=self.shares_script)

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        return {"text/html": self._repr_html_(), "text/plain": repr(self)}

    def __repr__(self) -> str:
        return f"<{self._title}: {len(self.html) / 1024:.0f} KiB>"


def replay(
    recording: Recording, *, speed: float = 1.0, moments: Sequence[Moment] = (), plays: bool = False
) -> Replay:
    """The run as a player with a scrub bar; it is stored in the notebook and in pages exported from it.

    speed: initial simulated seconds per second of playback. moments: stamps (s) with a text, marked in red;
    the replay opens a second before the first of them. It ends soon after the last thing that happens.
    plays: it starts at once, unless the reader's system asks for reduced motion.
    Without a world it shows a timeline of the topics. Raises ValueError for a speed that isn't above 0.
    """
    if not (speed > 0 and math.isfinite(speed)):
        raise ValueError(f"speed must be a number above 0; it is {speed!r}")
    return Replay(recording, float(speed), moments, plays)


def _still(recording: Recording) -> Plot:
    return plot_path(recording) if recording.world is not None else plot_topics(recording)
