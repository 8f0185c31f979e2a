"""What it costs to begin: imports and the first node, on rclpy alone and with the engine."""

import json
import statistics
import sys
import time
from collections.abc import Callable

from tests.bench.report import fresh, table

PROCESSES = 5


def by_rclpy() -> list[float]:
    """Import, first node, second node on rclpy alone: wall time in s."""

    def imports() -> None:
        import rclpy.node  # noqa: F401

    def node() -> None:
        import rclpy

        rclpy.init()
        rclpy.create_node("talker").destroy_node()
        rclpy.shutdown()

    return [_seconds(step) for step in (imports, node, node)]


def by_engine() -> list[float]:
    """Import, first run, second run of one node for 1 s of simulated time: wall time in s."""

    def imports() -> None:
        import sim  # noqa: F401

    def node() -> None:
        import rclpy

        from sim import run

        run(lambda: rclpy.create_node("talker"), seconds=1, quiet=True)

    return [_seconds(step) for step in (imports, node, node)]


def _seconds(step: Callable[[], None]) -> float:
    begin = time.perf_counter()
    step()
    return time.perf_counter() - begin


VARIANTS = {"rclpy alone: init, node, shutdown": by_rclpy, "engine: a run of 1 s with a node": by_engine}


def main() -> None:
    """Compare them."""
    print(f"Wall time in ms, medians of {PROCESSES} fresh processes")
    rows = []
    for name in VARIANTS:
        measured = [fresh("tests.bench.startup", name) for _ in range(PROCESSES)]
        columns = zip(*measured, strict=True)
        rows.append([name, *(f"{statistics.median(column) * 1e3:.0f}" for column in columns)])
    table(["", "import", "first node", "second node"], rows)


if __name__ == "__main__":
    print(json.dumps(VARIANTS[sys.argv[1]]())) if sys.argv[1:] else main()
