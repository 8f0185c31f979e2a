"""What this process has run last: whoever asks what is going on is told of this."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sim.evidence import Recording


@dataclass
class Latest:
    """The play under way, if one is, and the recording of the last run or play."""

    player: Any = None  # a sim.ros.play.player.Player, which is above this
    recording: Recording | None = None


latest = Latest()
