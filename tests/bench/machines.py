"""60 s with each machine and a student's node that moves it; the cart-pole is controlled at 100 Hz."""

import statistics
import time

from sim import run
from tests.bench.report import table
from tests.students.machines import arm, cart_pole, joint

SECONDS, RUNS = 60, 5
PROGRAMS = {"cart_pole": cart_pole.Balancer, "arm": arm.Follower, "joint": joint.Swinger}


def main() -> None:
    """Run each a few times."""
    rows = []
    for world, program in PROGRAMS.items():
        times = []
        for _ in range(RUNS):
            begin = time.perf_counter()
            recording = run(program, world=world, seconds=SECONDS, quiet=True)
            times.append(time.perf_counter() - begin)
        if recording.errors:
            raise RuntimeError(f"the run should have no errors. {recording.ended.detail}")
        usual = statistics.median(times)
        figures = [f"{usual:.2f}", f"{min(times):.2f}", f"{SECONDS / usual:.0f}"]
        rows.append([world, len(recording.published), *figures])
    print(f"{SECONDS} s of simulated time, {RUNS} runs each. Wall time in s.")
    table(["", "messages", "median", "best", "x real time"], rows)


if __name__ == "__main__":
    main()
