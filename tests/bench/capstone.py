"""How the delivery robot of tests/bench/delivery does in warehouses drawn from seeds.

python -m tests.bench.capstone --worlds 20 --seconds 600
"""

import argparse
import sys
from time import perf_counter

from grader.checks.shift import Shift, shift
from sim import Recording, World, run
from tests.bench.delivery.control import Control
from tests.bench.delivery.decision import Decision
from tests.bench.delivery.perception import Perception
from tests.bench.report import table

HEADER = ["seed", "delivered", "orders", "canceled, expired", "touched", "least charge", "m", "wall s", "x"]


def work(seed: int, seconds: float) -> Recording:
    """The three programs in the warehouse of this seed."""
    world = World.generate("warehouse", seed=seed)
    return run(Perception, Decision, Control, world=world, seconds=seconds, seed=seed, quiet=True)


def row(seed: int, done: Shift, seconds: float, wall: float) -> list[object]:
    """What a table says of one run; wall: seconds that it took."""
    lost = sum(job.status in ("canceled", "expired") for job in done.jobs)
    touched = ", ".join(f"{what} {count}" for what, count in done.touched.items()) or "-"
    least = min(share for _, share in done.battery)
    figures = [lost, touched, f"{least:.0%}", f"{done.way:.0f}", f"{wall:.1f}", f"{seconds / wall:.0f}"]
    return [f"{seed}", len(done.delivered), len(done.jobs), *figures]


def main() -> int:
    """Work in all of them; the exit status says whether a person was touched or nothing delivered."""
    parser = argparse.ArgumentParser("python -m tests.bench.capstone", description=__doc__.splitlines()[0])
    parser.add_argument("--worlds", type=int, default=20, help="how many; default 20")
    parser.add_argument("--first", type=int, default=0, help="the first one's seed; default 0")
    parser.add_argument("--seconds", type=float, default=600.0, help="of each run; default 600")
    options = parser.parse_args()
    rows, shifts, walls = [], [], []
    for seed in range(options.first, options.first + options.worlds):
        begin = perf_counter()
        recording = work(seed, options.seconds)
        walls.append(perf_counter() - begin)
        shifts.append(shift(recording))
        rows.append(row(seed, shifts[-1], options.seconds, walls[-1]))
        for error in recording.errors:
            print(f"{seed}: {error.node} {error.type}{error.says}")
    table(HEADER, rows)
    safe = sum(done.met_person is None for done in shifts)
    delivered = sum(len(done.delivered) for done in shifts)
    print(
        f"{delivered} orders delivered in {len(shifts)} runs, {safe} of which touched no one; "
        f"{options.seconds * len(walls) / sum(walls):.0f} times real time"
    )
    return int(safe < len(shifts) or not all(done.delivered for done in shifts))


if __name__ == "__main__":
    sys.exit(main())
