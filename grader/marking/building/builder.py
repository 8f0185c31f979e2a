"""The process that builds one package: its setup.py is a program of the student's, so nobody trusts it."""

from __future__ import annotations

import base64
import contextlib
import socket
from pathlib import Path

from grader.marking.sandbox import Limits
from grader.workspace.building import SECONDS, build_in
from sim.ros.remote import Wire, WireError

ENTRY = "grader.marking.building.builder:main"
PRELOAD = ("grader.marking.building.builder",)
LIMITS = Limits(
    memory_mb=1500, cpu_s=60, wall_s=SECONDS + 30, file_mb=16, threads=64, scratch_files=2048, programs=True
)


def main(sock: socket.socket) -> None:
    """Take {"sources": {path: base64}}, build, and say what `checked_built` takes."""
    wire = Wire(sock)
    with contextlib.suppress(WireError):
        told = wire.receive()["sources"]
        built = build_in(Path("ws"), {path: base64.b64decode(data) for path, data in told.items()})
        files = {path: base64.b64encode(data).decode() for path, data in built.files.items()}
        wire.send(files=files, programs=sorted(built.programs), said=built.said, problem=built.problem)
