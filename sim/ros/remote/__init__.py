"""Runs whose student nodes live in another process.

The leader process has the world, the course's nodes and the recording, and is trusted. The follower process
runs the student's nodes; it receives only what they may receive, at the simulated time at which they may.
"""

from sim.ros.fibers.exceptions import RemoteLost
from sim.ros.remote.remote import Remote
from sim.ros.remote.serving import serve
from sim.ros.remote.validation import trust_types_in
from sim.ros.remote.wire import Wire, WireBroken, WireClosed, WireError, WireTimeout

__all__ = [
    "Remote",
    "RemoteLost",
    "Wire",
    "WireBroken",
    "WireClosed",
    "WireError",
    "WireTimeout",
    "serve",
    "trust_types_in",
]
