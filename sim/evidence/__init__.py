"""What a run leaves behind: evidence as plain data.

A recording holds no live node. Messages are kept as the bytes that were sent (CDR, the format on the wire),
so nothing can change after the fact, and are turned back into message objects when somebody looks at them.

Stamps are simulated seconds since the start of the run; `since_start` makes such of the stamps in messages,
which are those of the clocks of the nodes. Poses are in the `map` frame: metres, and radians in
(-pi, pi].
"""

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
from sim.evidence.graph import Endpoint, Graph, TimerInfo
from sim.evidence.recording import Recording
from sim.evidence.rows import (
    INFRASTRUCTURE_TOPICS,
    BusyLoop,
    CallbackError,
    CallbackRun,
    Ended,
    Heard,
    LogLine,
    ParameterName,
    Pose,
    Seconds,
    Unheard,
    rate,
    since_start,
    stamps,
)

__all__ = [
    "CANCEL_REJECTED",
    "CANCEL_REQUESTED",
    "ENDINGS",
    "INFRASTRUCTURE_TOPICS",
    "REJECTED",
    "STATUSES",
    "BusyLoop",
    "Call",
    "CallbackError",
    "CallbackRun",
    "Crossing",
    "Ended",
    "Endpoint",
    "Goal",
    "Graph",
    "Heard",
    "LogLine",
    "ParameterName",
    "Pose",
    "Recording",
    "Seconds",
    "TimerInfo",
    "Unheard",
    "is_node_service",
    "rate",
    "since_start",
    "stamps",
]
