"""Nodes of a run that live in another process.

One process leads a run and is believed: it has the world, our own nodes and the recording. The other one only
serves the student's nodes; it hears what they may hear, when they may hear it.
"""

from sim.ros.fibers.exceptions import RemoteLost
from sim.ros.remote.remote import Remote
from sim.ros.remote.serving import serve
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
]
