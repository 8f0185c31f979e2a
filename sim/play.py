"""The door to playing: a run to watch and to drive, with its picture where there is a notebook; replays."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from sim.evidence import Recording
from sim.network import Network
from sim.notebook import in_notebook, refuse_outdated
from sim.ros.play.pacing import Pace
from sim.ros.play.player import Player
from sim.ros.session import Session
from sim.world import World


def play(
    *nodes: Any,
    world: str | World | None = None,
    seconds: float = 10.0,
    seed: int = 0,
    until: Callable[[Recording], bool] | None = None,
    quiet: bool = False,
    network: Network | None = None,
    speed: float = 1.0,
) -> Player:
    """Run ROS 2 nodes as `run` does, but along with the clock on the wall, to watch and drive them.

    speed: simulated seconds per second; math.inf for as fast as it goes. All else is as for `run`, and the
    recording is the same, unless somebody drives or stops it.

    In a notebook it shows a picture, returns at once, and plays on while other cells run; when it is over,
    its replay takes the picture's place. Without an event loop it returns when the run is over. What was
    played before is stopped. Raises what `run` raises, and ValueError for a speed that is none.
    """
    refuse_outdated(nodes)
    pace = Pace(speed)
    player = Player(Session(nodes, world, seconds, seed, until, quiet, caller="play", network=network), pace)
    if in_notebook():
        from sim.view.live import LiveView  # here, for it takes a while, and scripts do without Jupyter

        view = LiveView(player.recording.world)
        view.show()
        player.show(view)
    player.begin()
    return player


def replay(recording: Recording, *, speed: float) -> Any:
    """See `Recording.replay`."""
    from sim.view.replay import replay  # here, for it takes a while

    return replay(recording, speed=speed)
