"""200 runs in one process: what is left behind."""

import gc
import os
import threading
from pathlib import Path

from tests.bench.report import avoider_run, table

RUNS, WARM_UP = 200, 10


def held() -> list[object]:
    """What this process holds now: threads, Python's and all; file descriptors, ROS nodes, memory in MB."""
    from rclpy.node import Node

    gc.collect()
    resident = int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    return [
        threading.active_count(),
        len(os.listdir("/proc/self/task")),
        len(os.listdir("/proc/self/fd")),
        sum(isinstance(thing, Node) for thing in gc.get_objects()),
        f"{resident / 1e6:.1f}",
    ]


def main() -> None:
    """Run the same program again and again, and look."""
    rows = []
    for count in range(1, RUNS + 1):
        digest = avoider_run(world="room", seconds=2).digest
        if count == WARM_UP or count % 50 == 0:
            rows.append([f"after {count} runs", *held(), digest[:8]])
    table(["", "threads", "of all kinds", "descriptors", "nodes", "memory, MB", "digest"], rows)
    print(f"growth since run {WARM_UP}: {float(rows[-1][5]) - float(rows[0][5]):.1f} MB")


if __name__ == "__main__":
    main()
