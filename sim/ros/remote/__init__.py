"""Nodes of a run that live in another process."""

from sim.ros.remote.wire import Wire, WireBroken, WireClosed, WireError, WireTimeout

__all__ = ["Wire", "WireBroken", "WireClosed", "WireError", "WireTimeout"]
