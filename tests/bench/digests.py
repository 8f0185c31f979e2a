"""Equal runs give equal recordings: fresh processes, the second half of them on a busy machine.

python -m tests.bench.digests --runs 100 --python .venv311/bin/python --python .venv/bin/python
"""

import argparse
import contextlib
import json
import os
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator

from tests.bench.report import avoider_run, fresh, table

BUSY_LOOP = "while True: pass"


def digest_here() -> None:
    """Print the digest of a run with a robot and a student's main(), as JSON."""
    version = "{}.{}.{}".format(*sys.version_info)
    print(json.dumps([version, avoider_run(world="maze", seconds=20, seed=1).digest]))


@contextlib.contextmanager
def busy_machine() -> Iterator[None]:
    """Two busy processes for every core."""
    loops = [subprocess.Popen([sys.executable, "-c", BUSY_LOOP]) for _ in range(2 * (os.cpu_count() or 1))]
    try:
        yield
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()


def count(pythons: list[str], runs: int, seed: int) -> Counter[tuple[str, str]]:
    """(Python version, digest) of that many runs, the Pythons taking turns; every run hashes differently."""
    found = Counter()
    for index in range(runs):
        python = pythons[index % len(pythons)]
        one = fresh("tests.bench.digests", "--one", python=python, PYTHONHASHSEED=str(seed + index))
        found[tuple(one)] += 1
    return found


def main() -> None:
    """Count the digests."""
    parser = argparse.ArgumentParser("python -m tests.bench.digests", description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=12, help="how many processes; default 12")
    parser.add_argument(
        "--python", action="append", help="of an environment with the course; may be given again"
    )
    parser.add_argument("--one", action="store_true", help="one run in this process")
    options = parser.parse_args()
    if options.one:
        digest_here()
        return
    pythons = options.python or [sys.executable]
    idle = options.runs // 2
    machines = {"idle": count(pythons, idle, 0)}
    with busy_machine():
        machines["busy"] = count(pythons, options.runs - idle, idle)
    rows = [
        [machine, version, digest[:8], runs]
        for machine, found in machines.items()
        for (version, digest), runs in sorted(found.items())
    ]
    table(["machine", "Python", "digest", "runs"], rows)
    digests = {digest for found in machines.values() for _, digest in found}
    print(f"{len(digests)} distinct digest{'s' * (len(digests) > 1)} in {options.runs} fresh processes")
    sys.exit(len(digests) != 1)


if __name__ == "__main__":
    main()
