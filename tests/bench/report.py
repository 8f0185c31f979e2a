"""What all benchmarks share: a run, figures from a fresh process, and tables."""

import json
import os
import subprocess
import sys
from collections.abc import Sequence
from typing import Any

# One virtual environment's ROS libraries must not leak into another's Python.
NOT_INHERITED = ("LD_LIBRARY_PATH", "_ROS_WHEELS_BOOTSTRAP_COMPLETE")


def avoider_run(**settings: Any) -> Any:
    """The recording of the benchmarks' program, run quietly. Raises RuntimeError if it did not go its way."""
    from sim import run
    from tests.bench.avoider import main

    recording = run(main, quiet=True, **settings)
    if recording.ended.reason != "time" or recording.errors:
        raise RuntimeError(f"the run should last {recording.seconds:g} s. {recording.ended.detail}")
    return recording


def fresh(module: str, *arguments: str, python: str = sys.executable, **environment: str) -> Any:
    """What `python -m module arguments...` prints as JSON in its last line. Raises CalledProcessError."""
    inherited = {name: value for name, value in os.environ.items() if name not in NOT_INHERITED}
    done = subprocess.run(
        [python, "-m", module, *arguments],
        env=inherited | environment,
        check=True,
        stdout=subprocess.PIPE,
        text=True,
    )
    return json.loads(done.stdout.splitlines()[-1])


def table(header: Sequence[object], rows: Sequence[Sequence[object]]) -> None:
    """Print rows under a header: the first column to the left, the others to the right."""
    cells = [[str(cell) for cell in row] for row in (header, *rows)]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    for first, *others in cells:
        right = [cell.rjust(width) for cell, width in zip(others, widths[1:], strict=True)]
        print("  ".join([first.ljust(widths[0]), *right]), flush=True)
