"""Confined processes that a test commands."""
import contextlib
import json
import os
import re
import signal
import socket
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from grader.marking.sandbox import ProcessEnd, Sandbox
from tests.patience import PATIENCE, until

FEW = ("numpy",)  # what most tests preload: they test isolation, not ROS


class Commanded:
    """A confined process that does what the test says."""

    def __init__(self, sandbox: Sandbox) -> None:
        self.wire, child_end = socket.socketpair()
        self.wire.settimeout(PATIENCE)
        self.process = sandbox.start(child_end)
        self._lines = self.wire.makefile("rb")

    def tell(self, code: str) -> None:
        """Have Python code run inside, and do not wait."""
        self.wire.sendall(code.encode())

    def answer(self) -> Any:
        """What the code left in `answer`, or its error as "Name: text"; None if it is gone."""
        line = self._lines.readline()
        answer = json.loads(line) if line else {"answer": None}
        return f"{answer['error']}: {answer['text']}" if "error" in answer else answer["answer"]

    def ask(self, code: str) -> Any:
        """Have Python code run inside; see `answer`."""
        self.tell(code)
        return self.answer()

    def ending(self) -> ProcessEnd:
        """How it ended."""
        return self.process.wait(PATIENCE)

    def leave(self) -> None:
        """End it, if it still runs."""
        self.process.kill()
        self.process.wait(PATIENCE)
        self._lines.close()
        self.wire.close()


def sandbox(entry: str = "entries:obey", **options: Any) -> Sandbox:
    """A sandbox whose confined processes obey."""
    return Sandbox(entry, imports=[Path(__file__).parent], **({"preload": FEW} | options))


def fork_server(box: Sandbox) -> int:
    """The pid of the warm process of a sandbox."""
    about = Path(f"/proc/self/fdinfo/{box._warm._pidfd}").read_text()
    return int(re.search(r"^Pid:\s*(\d+)", about, re.M)[1])


def state(pid: int) -> str:
    """The state of a process, see proc(5): R for running, T for stopped."""
    return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]


@contextlib.contextmanager
def stopped(pid: int) -> Iterator[None]:
    """Keep a process from doing anything for a while."""
    os.kill(pid, signal.SIGSTOP)
    try:
        until(lambda: state(pid) == "T", "a process to stop")
        yield
    finally:
        os.kill(pid, signal.SIGCONT)
