"""Packs the motion of a run, for pages that show it as a path or as an animation."""

from __future__ import annotations

from sim.evidence import Recording
from sim.view.layers import layers_of
from sim.view.packing import deflated
from sim.view.replay_data import VERSION, event_marks, mark_rows, motion, run_end, run_key
from sim.view.strokes import all_strokes
from sim.view.world_data import world_data

FAILURE = 500  # characters


def pack_path(recording: Recording) -> str:
    """The path, contacts and pen strokes of a run with a world. Raises ValueError if nothing moved."""
    return _packed(recording, path=True, speed=1.0)


def pack_animation(recording: Recording, speed: float) -> str:
    """The same for a player without topics and log lines, which plays by itself at this speed."""
    return _packed(recording, plays=True, speed=speed)


def _packed(recording: Recording, **settings: bool | float) -> str:
    world, end = recording.world, run_end(recording)
    assert world is not None  # see above
    data = {
        **{"version": VERSION, "run": run_key(recording), "end": end, **settings},
        **{"failure": recording.failure[:FAILURE], "scans": [], "logs": [], "topics": []},
        **{"world": world_data(world, recording.bodies), **motion(recording)},
        "layers": layers_of(recording),
        "marks": mark_rows(event_marks(recording), (end, "end", "the run ended.", None)),
    }
    if recording.drawing is not None:
        data["drawing"] = all_strokes(recording.drawing)
    return deflated(data)
