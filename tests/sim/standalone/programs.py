"""Starts the robot and its clients as processes of their own, in a domain that nobody else uses."""

from __future__ import annotations

import contextlib
import itertools
import json
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[3]
CLIENTS = Path(__file__).with_name("clients.py")
LIMIT = 300  # wall seconds: only against hanging, for a busy machine is slow
_turns = itertools.count(os.getpid())


def free_domain() -> int:
    """A ROS domain whose first ports (DDSI-RTPS 9.6.1.1) nobody on this machine has taken."""
    for number in _turns:
        domain = number % 102
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe, contextlib.suppress(OSError):
            probe.bind(("127.0.0.1", 7400 + 250 * domain + 10))
            return domain
    raise AssertionError("never reached")


def environment(**more: str) -> dict[str, str]:
    """That of a terminal: what this process has set for its own runs is taken out."""
    mine = ("ROS_", "FASTDDS_", "RMW_", "RCUTILS_")
    plain = {name: value for name, value in os.environ.items() if not name.startswith(mine)}
    return plain | {"PYTHONPATH": str(REPOSITORY)} | more


class Robot:
    """python -m sim, in a domain of its own."""

    def __init__(self, *arguments: str) -> None:
        self.domain = free_domain()
        self.process = subprocess.Popen(
            [sys.executable, "-m", "sim", "--domain", str(self.domain), *arguments],
            cwd=REPOSITORY, env=environment(), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        self.offer = "".join(itertools.takewhile(lambda line: "Ctrl-C" not in line, self.process.stdout))
        assert self.offer, self.process.communicate()[1]

    def client(self, name: str, seconds: float) -> subprocess.Popen:
        """Start one of the programs of clients.py."""
        return subprocess.Popen(
            [sys.executable, str(CLIENTS), name, str(seconds)],
            env=environment(ROS_DOMAIN_ID=str(self.domain), ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST"),
            stdout=subprocess.PIPE, text=True,
        )  # fmt: skip

    def listen(self, seconds: float = 1.5) -> dict:
        """What a listener hears in that time."""
        return json.loads(finish(self.client("listen", seconds)))

    def receive_until(self, condition: Callable[[dict], bool]) -> None:
        """Listen again and again, until what is heard is as it should be."""
        end = time.monotonic() + LIMIT
        while not condition(received := self.listen(0.2)):
            assert time.monotonic() < end, received

    def memory(self) -> int:
        """Resident memory, kB."""
        status = Path(f"/proc/{self.process.pid}/status").read_text()
        return int(next(line.split()[1] for line in status.splitlines() if line.startswith("VmRSS")))

    def stop(self, number: int = signal.SIGINT) -> tuple[int, str]:
        """Send a signal; exit status and stderr."""
        self.process.send_signal(number)
        stderr = self.process.communicate(timeout=LIMIT)[1]
        return self.process.returncode, stderr


def ended(*arguments: str) -> tuple[int, str, str]:
    """How python -m sim ended with these words: exit status, stdout and stderr."""
    done = subprocess.run(
        [sys.executable, "-m", "sim", *arguments],
        cwd=REPOSITORY, env=environment(), capture_output=True, text=True, timeout=LIMIT, check=False,
    )  # fmt: skip
    return done.returncode, done.stdout, done.stderr


def finish(client: subprocess.Popen) -> str:
    """Wait until a client has ended by itself; what it printed."""
    output = client.communicate(timeout=LIMIT)[0]
    assert client.returncode == 0
    return output


@contextlib.contextmanager
def robot(*arguments: str) -> Iterator[Robot]:
    """A robot that is there, and gone afterwards whatever happens."""
    running = Robot(*arguments)
    try:
        yield running
    finally:
        running.process.kill()
        running.process.communicate()
