"""Replays of several robots beside each other: what moved and what was touched, and a ghost of another run.

They hold no word of the programs that ran: neither names nor log lines nor errors.
"""

from __future__ import annotations

import html
from bisect import bisect_right
from collections.abc import Iterator
from itertools import accumulate

from sim.evidence import Recording
from sim.view.geometry import world_data
from sim.view.packing import VERSION, deflated, inflated, mark_rows, motion, run_end, touches

GHOST = "ghost"  # a kind of body: shown, and no more
SPEED = 10.0  # simulated seconds per second of playing, to begin with


def pack_motion(recording: Recording) -> str:
    """What moved in a run with a world, as `player` takes it. Raises ValueError where nothing has."""
    end = run_end(recording)
    return deflated(
        {
            **{"version": VERSION, "speed": SPEED, "end": end, "scans": [], "logs": [], "topics": []},
            **{"world": world_data(recording.world, recording.bodies), **motion(recording)},
            "marks": mark_rows(touches(recording), (end, "end", "the run ended.", None)),
        }
    )


def player(packed: str, words: str, ghost: str = "") -> str:
    """The replay as a piece of HTML without a script, which PLAYER_SCRIPT makes a player of.

    packed, ghost: runs in the same world, from `pack_motion`; the first robot of the second one is the ghost.
    words: stand there until the script has run.
    """
    data = with_ghost(packed, ghost) if ghost else packed
    return f'<div class="ros2-replay" data-replay="{data}">{html.escape(words)}</div>'


def with_ghost(packed: str, other: str) -> str:
    """The first run, with the robot of the second one where it was at the same moments."""
    run, ghost = inflated(packed), inflated(other)
    body = {**ghost["world"]["bodies"][0], "name": GHOST, "kind": GHOST}
    moments, columns = list(accumulate(ghost["stamps"])), [list(accumulate(it)) for it in ghost["tracks"][0]]
    places = [max(bisect_right(moments, stamp) - 1, 0) for stamp in accumulate(run["stamps"])]
    track = [list(_steps(column[place] for place in places)) for column in columns]
    run["world"]["bodies"].append(body)
    run["tracks"].append(track)
    return deflated(run)


def _steps(values: Iterator[int]) -> Iterator[int]:
    before = 0
    for value in values:
        yield value - before
        before = value
