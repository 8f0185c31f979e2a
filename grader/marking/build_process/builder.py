"""The untrusted process that builds one package: it runs the student's setup.py."""

from __future__ import annotations

import contextlib
import socket
from pathlib import Path

from grader.marking.sandbox import ResourceLimits
from grader.workspace.building import SECONDS, build_in
from sim.ros.remote import Wire, WireError

ENTRY = "grader.marking.build_process.builder:main"
PRELOAD = ("grader.marking.build_process.builder",)
LIMITS = ResourceLimits(
    memory_mb=1500, cpu_s=60, wall_s=SECONDS + 30, file_mb=16, threads=64, scratch_files=2048, programs=True,
    idle_s=30,
)


def main(sock: socket.socket) -> None:
    """Receive {"sources": {path: bytes}}, build, and send the arguments of `parse_built`."""
    wire = Wire(sock)
    with contextlib.suppress(WireError):
        built = build_in(Path("ws"), wire.receive()["sources"])
        programs = sorted(built.programs)
        wire.send(files=dict(built.files), programs=programs, output=built.output, problem=built.problem)
