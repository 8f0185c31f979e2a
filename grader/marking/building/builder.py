"""The process that builds one package: its setup.py is a program of the student's, so nobody trusts it."""

from __future__ import annotations

import contextlib
import socket
from pathlib import Path

from grader.marking.sandbox import ResourceLimits
from grader.workspace.building import SECONDS, build_in
from sim.ros.remote import Wire, WireError

ENTRY = "grader.marking.building.builder:main"
PRELOAD = ("grader.marking.building.builder",)
LIMITS = ResourceLimits(
    memory_mb=1500, cpu_s=60, wall_s=SECONDS + 30, file_mb=16, threads=64, scratch_files=2048, programs=True
)


def main(sock: socket.socket) -> None:
    """Take {"sources": {path: bytes}}, build, and say what `checked_built` takes."""
    wire = Wire(sock)
    with contextlib.suppress(WireError):
        told = wire.receive()["sources"]
        built = build_in(Path("ws"), told)
        programs = sorted(built.programs)
        wire.send(files=dict(built.files), programs=programs, said=built.said, problem=built.problem)
