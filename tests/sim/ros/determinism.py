"""Equal runs have equal digests in many fresh processes, half of them on a busy machine.

    python -m tests.sim.ros.determinism --runs 100 .venv/bin/python /elsewhere/.venv/bin/python

The Pythons take turns, each with another PYTHONHASHSEED. Prints how many processes had which digest; ends
with 0 when there is only one.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[3]
# What leads another environment's Python to this one's ROS libraries.
OURS = ("LD_LIBRARY_PATH", "_ROS_WHEELS_BOOTSTRAP_COMPLETE", "VIRTUAL_ENV", "PYTHONPATH", "AMENT_PREFIX_PATH")


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
    environment = {name: value for name, value in os.environ.items() if name not in OURS}
    environment |= {"PYTHONHASHSEED": str(hash_seed), "PYTHONPATH": str(REPOSITORY)}
    command = [str(python), "-m", "tests.sim.ros.programs"]
    done = subprocess.run(
        command, cwd=REPOSITORY, env=environment, check=False, capture_output=True, text=True, timeout=300
    )
    if done.returncode:
        return f"failed with {done.returncode}: {done.stderr.strip()[-500:]}"
    return done.stdout.strip()


def count(pythons: list[str], runs: int) -> Counter[str]:
    """How often each line of digests came up; the second half of the runs on a busy machine."""
    seen: Counter[str] = Counter()
    for number in range(runs):
        load = 2 * (os.cpu_count() or 1) if number >= runs // 2 else 0
        with busy_machine(load):
            seen[digests(pythons[number % len(pythons)], number + 1)] += 1
    return seen


def main() -> int:
    """Run from the command line; 0 if all digests were equal."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("pythons", nargs="*", default=[sys.executable], help="interpreters with the course")
    parser.add_argument("--runs", type=int, default=100)
    arguments = parser.parse_args()
    for python in arguments.pythons:
        if not Path(python).exists():
            parser.error(f"there is no Python {python}")
    seen = count(arguments.pythons, arguments.runs)
    for line, times in seen.most_common():
        sys.stdout.write(f"{times:4} processes: {line}\n")
    return 0 if len(seen) == 1 else 1


if __name__ == "__main__":
    sys.exit(main())
