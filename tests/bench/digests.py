"""Equal runs, of every world too, give equal recordings: fresh processes, half of them on a busy machine.

python -m tests.bench.digests --runs 100 --python .venv311/bin/python --python .venv/bin/python
"""

import argparse
import os
import sys
from collections import Counter

from tests.bench.report import table
from tests.sim.ros.determinism import busy_machine, digests


def count(pythons: list[str], hash_seeds: range) -> Counter[tuple[str, str]]:
    """(Python, digests of its scenarios), a process for each hash seed, the Pythons taking turns."""
    turns = [(pythons[seed % len(pythons)], seed) for seed in hash_seeds]
    return Counter((python, digests(python, seed)) for python, seed in turns)


def main() -> None:
    """Count the digests."""
    parser = argparse.ArgumentParser("python -m tests.bench.digests", description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=12, help="how many processes; default 12")
    parser.add_argument(
        "--python", action="append", help="of an environment with the course; may be given again"
    )
    options = parser.parse_args()
    pythons = options.python or [sys.executable]
    missing = [python for python in pythons if not os.path.exists(python)]
    if missing:
        parser.error(f"there is no Python {missing[0]}")
    idle = options.runs // 2
    machines = {"idle": count(pythons, range(idle))}
    with busy_machine(2 * (os.cpu_count() or 1)):
        machines["busy"] = count(pythons, range(idle, options.runs))
    rows = [
        [machine, python, " ".join(one[:4] for one in found.split()), runs]
        for machine, counted in machines.items()
        for (python, found), runs in sorted(counted.items())
    ]
    table(["machine", "Python", "digests", "runs"], rows)
    distinct = {found for counted in machines.values() for _, found in counted}
    print(f"{len(distinct)} distinct recording{'s' * (len(distinct) > 1)} in {options.runs} fresh processes")
    sys.exit(len(distinct) != 1)


if __name__ == "__main__":
    main()
