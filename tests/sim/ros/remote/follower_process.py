"""A process that serves students' nodes, for tests of runs in two processes.

python -m tests.sim.ros.remote.follower_process FD    serves nodes that are named over this socket
"""

from __future__ import annotations

import contextlib
import importlib
import os
import socket
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from sim.ros.remote import Remote, Wire, WireClosed, serve
from tests.patience import PATIENCE
from tests.students.teams import programs_of

ROOT = Path(__file__).parents[4]


class FollowerProcess:
    """The process, and the leader's end of the wire."""

    def __init__(self) -> None:
        self._begin()

    def _begin(self) -> None:
        near, far = socket.socketpair()
        command = [sys.executable, "-m", "tests.sim.ros.remote.follower_process", str(far.fileno())]
        environment = {name: value for name, value in os.environ.items() if name != "COURSE_SECRET"}
        self._folder = tempfile.TemporaryDirectory(prefix="follower-")  # remains when the process is killed
        environment["TMPDIR"] = self._folder.name
        self.process = subprocess.Popen(command, cwd=ROOT, env=environment, pass_fds=[far.fileno()])
        far.close()
        self.wire = Wire(near)

    @contextlib.contextmanager
    def serving(
        self, module: str, *names: str, patience: float = PATIENCE, secret: str = ""
    ) -> Iterator[Remote]:
        """A program that represents nodes of a module; after an error, the process is replaced."""
        self.wire.send(module=module, names=names)
        remote = Remote(self.wire, patience, secret=secret)
        try:
            yield remote
            remote.end()
        except BaseException:
            self.close()
            self._begin()
            raise

    def close(self) -> None:
        """End the process."""
        self.wire.close()
        self.process.kill()
        self.process.wait()
        self._folder.cleanup()


def main() -> None:
    """Serve until the connection is closed."""
    wire = Wire(socket.socket(fileno=int(sys.argv[1])))
    try:
        while True:
            order = wire.receive()
            module = importlib.import_module(order["module"])
            entries = [getattr(module, name) for name in order["names"]]
            serve(wire, [program for entry in entries for program in programs_of(entry)])
    except WireClosed:
        pass


if __name__ == "__main__":
    main()
