"""What all benchmarks share: a run, figures from a fresh process, and tables."""

import json
import subprocess
import sys
from collections.abc import Sequence
from typing import Any


def avoider_run(program: Any = None, **settings: Any) -> Any:
    """The recording of the benchmarks' program, run quietly. Raises RuntimeError if it did not go its way.

    program: stands for it where it lives in another process.
    """
    from sim import run
    from tests.bench.avoider import main

    recording = run(program or main, quiet=True, **settings)
    if recording.ended.reason != "time" or recording.errors:
        raise RuntimeError(f"the run should last {recording.seconds:g} s. {recording.ended.detail}")
    return recording


def fresh(module: str, *arguments: str) -> Any:
    """What `python -m module arguments...` prints as JSON in its last line. Raises CalledProcessError."""
    command = [sys.executable, "-m", module, *arguments]
    done = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True)
    return json.loads(done.stdout.splitlines()[-1])


def table(header: Sequence[object], rows: Sequence[Sequence[object]]) -> None:
    """Print rows under a header: the first column to the left, the others to the right."""
    cells = [[str(cell) for cell in row] for row in (header, *rows)]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    for first, *others in cells:
        right = [cell.rjust(width) for cell, width in zip(others, widths[1:], strict=True)]
        print("  ".join([first.ljust(widths[0]), *right]), flush=True)
