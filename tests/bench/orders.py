"""The cost of another order than the usual one, with and without threads, and of finding one that fails."""

import statistics
import time
from collections.abc import Callable
from functools import partial
from typing import Any

from sim import explore, run
from tests.bench.report import avoider_run, table
from tests.sim.ros.racy_programs import PROGRAMS, CountsUnderLock

ROUNDS = 5
ORDERS = 10


def no_errors(recording: Any) -> bool:
    """Whether it holds."""
    return not recording.errors


def threads(order: int) -> None:
    """Two threads that take turns with a lock, and a timer."""
    run(CountsUnderLock, seconds=2, quiet=True, order=order)


VARIANTS: dict[str, Callable[[int], Any]] = {
    "60 s of the robot in a room": lambda order: avoider_run(world="room", seconds=60, order=order),
    "2 s of two threads": threads,
}


def computed(call: Callable[[], Any]) -> float:
    """Seconds of computing that a call takes."""
    begin = time.process_time()
    call()
    return time.process_time() - begin


def main() -> None:
    """Compare orders with the usual one, in turn; then find and shrink each racy program of the tests."""
    rows = []
    for name, variant in VARIANTS.items():
        variant(0), variant(1)  # imports, and the first rewriting of the code
        usual, other = [], []
        for _ in range(ROUNDS):
            usual.append(computed(partial(variant, 0)))
            other += [computed(partial(variant, order)) for order in range(1, ORDERS + 1)]
        ratio = statistics.median(other) / statistics.median(usual)
        figures = [f"{1000 * statistics.median(times):.0f}" for times in (usual, other)]
        rows.append([name, *figures, f"{ratio:.2f}"])
    print("CPU time in ms (medians), of the usual order and of others, and their ratio.")
    table(["", "order 0", "another", "ratio"], rows)
    rows = []
    for name, racy in PROGRAMS.items():
        begin = time.perf_counter()
        found = explore(*racy.wrong, holds=no_errors, level=racy.level, seconds=racy.seconds)
        seconds = f"{time.perf_counter() - begin:.1f}"
        rows.append([name, racy.level, found.number, len(found.departures), seconds])
    print("\nRacy programs: the order in which each fails first, its departures in the end, s of wall time.")
    table(["", "level", "order", "departures", "s"], rows)


if __name__ == "__main__":
    main()
