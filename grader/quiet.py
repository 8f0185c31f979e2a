"""Keep standard error empty: nbgrader gives 0 points to a test cell that wrote anything there."""

from __future__ import annotations

import io
import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager

LIMIT = 4000  # characters that are shown of what was caught


@contextmanager
def quiet_stderr() -> Iterator[None]:
    """Send what goes to standard error to standard output instead, once the block is over.

    That is Python's sys.stderr, also where a logging handler took hold of it earlier, and file descriptor 2,
    which rclpy and C libraries write to.
    """
    python = io.StringIO()
    with tempfile.TemporaryFile() as native, _descriptor_2(native.fileno()), _python_stderr(python):
        try:
            yield
        finally:
            native.seek(0)
            caught = native.read().decode(errors="replace") + python.getvalue()
            if caught:
                print(caught if len(caught) <= LIMIT else caught[:LIMIT] + "\n... and so on")


@contextmanager
def _descriptor_2(target: int) -> Iterator[None]:
    saved = os.dup(2)
    os.dup2(target, 2)
    try:
        yield
    finally:
        os.dup2(saved, 2)
        os.close(saved)


@contextmanager
def _python_stderr(target: io.StringIO) -> Iterator[None]:
    original = sys.stderr
    # A handler that logging set up earlier holds the object itself, so the object must write elsewhere, too.
    # A notebook's stream flushes by waiting for a thread, which in a run would be a wait in simulated time.
    held = getattr(original, "__dict__", {})
    before = {name: held.pop(name) for name in ("write", "flush") if name in held}
    sys.stderr = target
    held.update(write=target.write, flush=target.flush)
    try:
        yield
    finally:
        sys.stderr = original
        del held["write"], held["flush"]
        held.update(before)
