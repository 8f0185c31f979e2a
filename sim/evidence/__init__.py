"""The recording of a run, as plain data.

A recording holds no live node. Messages are stored as the bytes that were sent (CDR, the format on the wire),
so nothing can change after the fact, and are decoded into message objects when they are read.

Stamps are simulated seconds since the start of the run; `since_start` makes such of the stamps in messages,
which are those of the clocks of the nodes. Poses are in the `map` frame: meters, and radians in
(-pi, pi].
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sim.evidence.crossings import Crossing
    from sim.evidence.exchanges import (
        CANCEL_REJECTED,
        CANCEL_REQUESTED,
        ENDINGS,
        REJECTED,
        STATUSES,
        Call,
        Goal,
        is_node_service,
    )
    from sim.evidence.failure import first_error, first_line, frames_of, last_line, place_of
    from sim.evidence.graph import Endpoint, Graph, TimerInfo
    from sim.evidence.recording import Recording
    from sim.evidence.rows import (
        BUNDLED,
        CALLS_PUBLISH,
        FACTS,
        INFRASTRUCTURE_TOPICS,
        NAMELESS,
        RATE,
        SPUN,
        TAKEN_OVER,
        UNFINISHED,
        UNMATCHED,
        WATCHES,
        BusyLoop,
        CallbackError,
        CallbackRun,
        Departure,
        Ended,
        LogLine,
        Message,
        NodeFact,
        ParameterName,
        Pose,
        Seconds,
        UndeliveredMessage,
        rate,
        since_start,
        stamps,
    )

# Each name is imported on first use: the command `ros2` needs few of them, and no world.
_MODULES = {
    "sim.evidence.crossings": ("Crossing",),
    "sim.evidence.exchanges": (
        "CANCEL_REJECTED",
        "CANCEL_REQUESTED",
        "ENDINGS",
        "REJECTED",
        "STATUSES",
        "Call",
        "Goal",
        "is_node_service",
    ),
    "sim.evidence.failure": (
        "first_error",
        "first_line",
        "frames_of",
        "last_line",
        "place_of",
    ),
    "sim.evidence.graph": (
        "Endpoint",
        "Graph",
        "TimerInfo",
    ),
    "sim.evidence.recording": ("Recording",),
    "sim.evidence.rows": (
        "BUNDLED",
        "CALLS_PUBLISH",
        "FACTS",
        "INFRASTRUCTURE_TOPICS",
        "NAMELESS",
        "RATE",
        "SPUN",
        "TAKEN_OVER",
        "UNFINISHED",
        "UNMATCHED",
        "WATCHES",
        "BusyLoop",
        "CallbackError",
        "CallbackRun",
        "Departure",
        "Ended",
        "LogLine",
        "Message",
        "NodeFact",
        "ParameterName",
        "Pose",
        "Seconds",
        "UndeliveredMessage",
        "rate",
        "since_start",
        "stamps",
    ),
}
_HOMES = {name: module for module, names in _MODULES.items() for name in names}

__all__ = [
    "BUNDLED",
    "CALLS_PUBLISH",
    "CANCEL_REJECTED",
    "CANCEL_REQUESTED",
    "ENDINGS",
    "FACTS",
    "INFRASTRUCTURE_TOPICS",
    "NAMELESS",
    "RATE",
    "REJECTED",
    "SPUN",
    "STATUSES",
    "TAKEN_OVER",
    "UNFINISHED",
    "UNMATCHED",
    "WATCHES",
    "BusyLoop",
    "Call",
    "CallbackError",
    "CallbackRun",
    "Crossing",
    "Departure",
    "Ended",
    "Endpoint",
    "Goal",
    "Graph",
    "LogLine",
    "Message",
    "NodeFact",
    "ParameterName",
    "Pose",
    "Recording",
    "Seconds",
    "TimerInfo",
    "UndeliveredMessage",
    "first_error",
    "first_line",
    "frames_of",
    "is_node_service",
    "last_line",
    "place_of",
    "rate",
    "since_start",
    "stamps",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    found = globals()[name] = getattr(importlib.import_module(_HOMES[name]), name)
    return found
