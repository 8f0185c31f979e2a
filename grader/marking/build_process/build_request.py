"""Requests a build in the sandbox for a judge, and checks the answer, which is untrusted."""

from __future__ import annotations

import socket
from collections.abc import Callable

from grader.workspace.building import NOT_TAKEN, SECONDS, Built, parse_built
from grader.workspace.sources import InvalidFiles, Sources
from sim.ros.remote import Wire, WireError

MESSAGE = 6_000_000  # bytes
SPARE_S = 120.0  # until the process is there, on a busy machine
BROKE_OFF = "colcon build ended unexpectedly."


def request_build(sock: socket.socket, sources: Sources, describe_end: Callable[[], str]) -> Built:
    """Have the process at the other end of the socket build. Raises nothing, whatever the package does.

    describe_end: called when the process has died; returns how it ended, as a sentence, or "".
    """
    with sock:
        wire = Wire(sock, MESSAGE)
        try:
            wire.send(sources=dict(sources))
            answer = wire.receive(SECONDS + SPARE_S)
        except WireError:
            return Built(problem=f"{BROKE_OFF} {describe_end()}".strip())
    try:
        return parse_built(*(answer.get(name) for name in ("files", "programs", "output", "problem")))
    except InvalidFiles as reason:
        return Built(problem=f"{NOT_TAKEN} {reason}")
