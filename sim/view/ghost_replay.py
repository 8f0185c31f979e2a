"""Replays that show only motion and contacts, with the robot of another run as a ghost; for the league.

They contain nothing of the programs that ran: no names, log lines or errors.
"""

from __future__ import annotations

import html
from bisect import bisect_right
from collections.abc import Iterator
from itertools import accumulate

from sim.evidence import Recording
from sim.view.packing import deflated, inflated
from sim.view.replay_data import VERSION, contact_marks, mark_rows, motion, run_end
from sim.view.world_data import world_data

GHOST = "ghost"  # kind of a body that is only drawn
SPEED = 10.0  # initial simulated seconds per second of playback


def pack_motion(recording: Recording) -> str:
    """The motion and contacts of a run with a world, for `player`. Raises ValueError if nothing moved."""
    world, end = recording.world, run_end(recording)
    assert world is not None  # see above
    return deflated(
        {
            **{"version": VERSION, "speed": SPEED, "end": end, "scans": [], "logs": [], "topics": []},
            **{"world": world_data(world, recording.bodies), **motion(recording)},
            "marks": mark_rows(contact_marks(recording), (end, "end", "the run ended.", None)),
        }
    )


def player(packed: str, fallback: str, ghost: str = "") -> str:
    """The replay as HTML without a script; PLAYER_SCRIPT turns it into a player.

    packed, ghost: runs in the same world, from `pack_motion`; the first robot of the second run is the ghost.
    fallback: the text that is shown until the script has run.
    """
    data = with_ghost(packed, ghost) if ghost else packed
    return f'<div class="ros2-replay" data-replay="{data}">{html.escape(fallback)}</div>'


def with_ghost(packed: str, other: str) -> str:
    """The first run with the robot of the second run added, at equal times."""
    run, ghost = inflated(packed), inflated(other)
    body = {**ghost["world"]["bodies"][0], "name": GHOST, "kind": GHOST}
    times, columns = list(accumulate(ghost["stamps"])), [list(accumulate(it)) for it in ghost["tracks"][0]]
    indices = [max(bisect_right(times, stamp) - 1, 0) for stamp in accumulate(run["stamps"])]
    track = [list(_differences(column[index] for index in indices)) for column in columns]
    run["world"]["bodies"].append(body)
    run["tracks"].append(track)
    return deflated(run)


def _differences(values: Iterator[int]) -> Iterator[int]:
    previous = 0
    for value in values:
        yield value - previous
        previous = value
