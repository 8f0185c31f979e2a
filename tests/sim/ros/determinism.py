"""Fresh processes, other Pythons and busy machines, for comparing digests."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from tests.patience import PATIENCE

REPOSITORY = Path(__file__).resolve().parents[3]
# What leads another environment's Python to this one's ROS libraries.
OWN = ("LD_LIBRARY_PATH", "_ROS_WHEELS_BOOTSTRAP_COMPLETE", "VIRTUAL_ENV", "PYTHONPATH", "AMENT_PREFIX_PATH")


@contextlib.contextmanager
def busy_machine(processes: int) -> Iterator[None]:
    """Processes that do nothing but compute, two for each processor."""
    loops = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(processes)]
    try:
        yield
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()


def digests(python: str | Path, hash_seed: int) -> str:
    """The digests of all scenarios in a fresh process, or how it failed."""
    environment = {name: value for name, value in os.environ.items() if name not in OWN}
    environment |= {"PYTHONHASHSEED": str(hash_seed), "PYTHONPATH": str(REPOSITORY)}
    command = [str(python), "-m", "tests.sim.ros.programs"]
    done = subprocess.run(
        command,
        cwd=REPOSITORY,
        env=environment,
        check=False,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
    )
    if done.returncode:
        return f"failed with {done.returncode}: {done.stderr.strip()[-500:]}"
    return done.stdout.strip()
