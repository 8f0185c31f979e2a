"""`play`, a run in real time to watch and drive, with a live view in notebooks; and replays of recordings."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from sim.evidence import Recording
from sim.network import Network
from sim.notebook import in_notebook, raise_if_outdated, report_failure
from sim.ros.play.pacing import Pace
from sim.ros.play.player import Player
from sim.ros.play.pointer import Pointer
from sim.ros.play.teleop import Teleop
from sim.ros.session import Session
from sim.world import World


def play(
    *nodes: Any,
    world: str | World | None = None,
    seconds: float | None = None,
    seed: int = 0,
    until: Callable[[Recording], bool] | None = None,
    quiet: bool = False,
    network: Network | None = None,
    order: int | str = 0,
    speed: float = 1.0,
    expect_error: bool = False,
    bag: str | Path | None = None,
) -> Player:
    """Run ROS 2 nodes as `run` does, but paced by the wall clock, to watch and drive them.

    speed: simulated seconds per second; math.inf for as fast as possible. All other arguments are those of
    `run`, and the recording is the same, unless a user drives the robot or stops the run.

    In a notebook it shows a live view, returns at once, and continues while other cells run; at the end the
    replay replaces the live view. Without an event loop it returns when the run has ended. A previous `play`
    that is still running is stopped. Raises what `run` raises, and ValueError for an invalid speed.
    """
    raise_if_outdated(nodes)
    pace = Pace(speed)
    common = nodes, world, seconds, seed, until, quiet
    player = Player(Session(*common, caller="play", network=network, order=order, bag=bag), pace)
    if in_notebook():
        from sim.view.live_view import (
            LiveView,  # imported here because it is slow, and scripts don't need Jupyter
        )

        view = LiveView(player.recording.world, reports=not expect_error, inputs=_inputs(nodes))
        view.show()
        player.show(view)
    player.begin()
    if player.over and not expect_error:  # it was played without an event loop
        report_failure(player.recording)
    return player


def _inputs(nodes: Sequence[Any]) -> list[str]:
    """Return what nodes read from the live picture: "keys" for a Teleop, "points" for a Pointer."""
    targets = [getattr(node, "target", node) for node in nodes]
    classes = [target for target in targets if isinstance(target, type)]
    kinds = {"keys": Teleop, "points": Pointer}
    return [name for name, kind in kinds.items() if any(issubclass(one, kind) for one in classes)]


def replay(
    recording: Recording, *, speed: float, moments: Sequence[tuple[float, str]] = (), plays: bool = False
) -> Any:
    """See `Recording.replay`."""
    from sim.view.replay import replay  # imported here because it is slow

    return replay(recording, speed=speed, moments=moments, plays=plays)
