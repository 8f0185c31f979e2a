"""A process of its own that serves students' nodes; for the tests of runs in two processes.

python -m tests.sim.ros.remote.apart FD    serves the nodes that it is told of over this socket
"""

from __future__ import annotations

import importlib
import os
import socket
import subprocess
import sys
from pathlib import Path

import grader.exercises.nodes  # noqa: F401  (it knows what to answer and to prepare)
from sim.ros.remote import Remote, Wire, WireClosed, serve

ROOT = Path(__file__).parents[4]


class Apart:
    """The process, and our end of the wire to it."""

    def __init__(self) -> None:
        ours, theirs = socket.socketpair()
        command = [sys.executable, "-m", "tests.sim.ros.remote.apart", str(theirs.fileno())]
        environment = {name: value for name, value in os.environ.items() if name != "COURSE_SECRET"}
        self.process = subprocess.Popen(command, cwd=ROOT, env=environment, pass_fds=[theirs.fileno()])
        theirs.close()
        self.wire = Wire(ours)

    def serving(self, module: str, *names: str, patience: float = 30.0) -> Remote:
        """What stands here for nodes of a module, until its `end`."""
        self.wire.send(module=module, names=names)
        return Remote(self.wire, patience)

    def close(self) -> None:
        """Let it go."""
        self.wire.close()
        self.process.kill()
        self.process.wait()


def main() -> None:
    """Serve, until the other side hangs up."""
    wire = Wire(socket.socket(fileno=int(sys.argv[1])))
    try:
        while True:
            order = wire.receive()
            module = importlib.import_module(order["module"])
            serve(wire, [getattr(module, name) for name in order["names"]])
    except WireClosed:
        pass


if __name__ == "__main__":
    main()
