"""Starts the robot and its clients as processes of their own, in a domain that no one else uses."""

from __future__ import annotations

import contextlib
import fcntl
import itertools
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import IO, Any

from tests.patience import PATIENCE, until

REPOSITORY = Path(__file__).resolve().parents[3]
CLIENTS = Path(__file__).with_name("clients.py")
_turns = itertools.count(os.getpid())


class Domain(int):
    """A ROS domain that no other test on this machine takes as long as this object is there."""

    lock: IO[bytes]


def free_domain() -> Domain:
    """A ROS domain whose first ports (DDSI-RTPS 9.6.1.1) are free, and that no other test has taken."""
    return until(_next_domain, "a free ROS domain")


def _next_domain() -> Domain | None:
    """The domain whose turn it is, or None if it is taken."""
    domain = Domain(next(_turns) % 102)
    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe,
        contextlib.suppress(OSError),
        contextlib.ExitStack() as stack,
    ):
        domain.lock = stack.enter_context(open(Path(tempfile.gettempdir(), f"ros_domain_{domain}"), "wb"))
        fcntl.flock(domain.lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        probe.bind(("127.0.0.1", 7400 + 250 * domain + 10))
        stack.pop_all()
        return domain
    return None


def environment(**more: str) -> dict[str, str]:
    """That of a terminal: what this process has set for its own runs is taken out."""
    mine = ("ROS_", "FASTDDS_", "RMW_", "RCUTILS_")
    plain = {name: value for name, value in os.environ.items() if not name.startswith(mine)}
    return plain | {"PYTHONPATH": str(REPOSITORY)} | more


class Robot:
    """python -m sim, in a domain of its own."""

    def __init__(self, *arguments: str) -> None:
        self.domain = free_domain()
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 (as long as this object is there)
        self.process = subprocess.Popen(
            [sys.executable, "-m", "sim", "--domain", str(self.domain), *arguments],
            cwd=REPOSITORY, env=environment(), stdout=subprocess.PIPE, stderr=self._errors, text=True,
        )  # fmt: skip
        self.offer = "".join(itertools.takewhile(lambda line: "Ctrl-C" not in line, self.process.stdout))
        assert self.offer, self.stderr

    @property
    def stderr(self) -> str:
        """What it has written there by now."""
        return os.pread(self._errors.fileno(), 1 << 20, 0).decode()

    @contextlib.contextmanager
    def beside(self, name: str) -> Iterator[subprocess.Popen]:
        """Have one of the programs of clients.py that don't end beside it, from when it has begun."""
        client = self.client(name)
        try:
            while (line := client.stdout.readline()) != "here\n":  # the middleware may warn of others' files
                assert line, name
            yield client
        finally:
            client.terminate()
            client.send_signal(signal.SIGCONT)
            client.communicate()

    def client(self, name: str) -> subprocess.Popen:
        """Start one of the programs of clients.py."""
        return subprocess.Popen(
            [sys.executable, str(CLIENTS), name],
            env=environment(ROS_DOMAIN_ID=str(self.domain), ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST"),
            stdout=subprocess.PIPE, text=True,
        )  # fmt: skip

    def listen(self) -> dict:
        """What a listener receives that starts now: the frame of a new scan, position and speed."""
        return finish(self.client("listen"))

    def receive_until(self, condition: Callable[[dict], bool]) -> None:
        """Listen again and again, until what is received is as it should be."""
        until(lambda: condition(self.listen()), "the robot")

    def memory(self) -> int:
        """Resident memory, kB."""
        status = Path(f"/proc/{self.process.pid}/status").read_text()
        return int(next(line.split()[1] for line in status.splitlines() if line.startswith("VmRSS")))

    def stop(self, number: int = signal.SIGINT) -> tuple[int, str]:
        """Send a signal; exit status and stderr."""
        self.process.send_signal(number)
        self.process.communicate(timeout=PATIENCE)
        return self.process.returncode, self.stderr


def ended(*arguments: str) -> tuple[int, str, str]:
    """How python -m sim ended with these words: exit status, stdout and stderr."""
    done = subprocess.run(
        [sys.executable, "-m", "sim", *arguments],
        cwd=REPOSITORY, env=environment(), capture_output=True, text=True, timeout=PATIENCE, check=False,
    )  # fmt: skip
    return done.returncode, done.stdout, done.stderr


def finish(client: subprocess.Popen) -> Any:
    """Wait until a client has ended by itself; what it printed last."""
    output = client.communicate(timeout=PATIENCE)[0]
    assert client.returncode == 0
    return json.loads(output.splitlines()[-1])


@contextlib.contextmanager
def robot(*arguments: str) -> Iterator[Robot]:
    """A robot that is there, and gone afterwards whatever happens."""
    running = Robot(*arguments)
    try:
        yield running
    finally:
        running.process.kill()
        running.process.communicate()
