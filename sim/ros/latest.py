"""The current play and the last run of this process, for `%ros2` in a cell."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sim.evidence import Recording


@dataclass
class Latest:
    """The current play, if any, and the recording of the last run or play."""

    player: Any = None  # a sim.ros.play.player.Player, which is above this
    recording: Recording | None = None


latest = Latest()
