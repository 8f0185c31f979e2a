"""What it costs to give each student a process of its own, in the sandbox and without."""

import statistics
import time

from grader.marking.sandbox import Sandbox
from grader.marking.sandbox.sandbox import PRELOAD
from tests.bench.report import table
from tests.marking.sandbox.commanded import Commanded, sandbox

PROCESSES = 20
RUN = """
import rclpy
from sim import run
run(lambda: rclpy.create_node("talker"), seconds=1, quiet=True)
"""


def one(box: Sandbox) -> tuple[float, float, float, float]:
    """Wall times (s) of a process: to its first answer, of its first run, of its end; its memory (MB)."""
    began = time.perf_counter()
    commanded = Commanded(box)
    commanded.ask("answer = 1")
    answered = time.perf_counter()
    commanded.ask(RUN)
    ran = time.perf_counter()
    commanded.leave()
    return answered - began, ran - answered, time.perf_counter() - ran, commanded.process.memory()


def main() -> None:
    """Compare the sandbox with plain processes."""
    rows = []
    for name, unsafe in (("in the sandbox", False), ("without", True)):
        began = time.perf_counter()
        with sandbox(preload=PRELOAD, unsafe=unsafe) as box:
            warm = time.perf_counter() - began
            *times, memory = zip(*(one(box) for _ in range(PROCESSES)), strict=True)
        medians = [f"{statistics.median(column) * 1e3:.0f}" for column in times]
        rows.append([name, f"{warm * 1e3:.0f}", *medians, f"{statistics.median(memory):.0f}"])
    print(f"Wall time in ms, medians of {PROCESSES} processes; most memory of one in MB, most of it shared")
    table(["", "warm process", "fork to first answer", "first run", "end", "memory"], rows)


if __name__ == "__main__":
    main()
