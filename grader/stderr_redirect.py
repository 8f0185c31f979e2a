"""Redirects standard error, because nbgrader gives 0 points to a test cell that wrote to it."""

from __future__ import annotations

import io
import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager

LIMIT = 4000  # characters of the captured text that are printed


@contextmanager
def redirect_stderr() -> Iterator[None]:
    """Capture standard error, and print it to standard output at the end of the block.

    This includes Python's sys.stderr, even if a logging handler references it, and file descriptor 2, to
    which rclpy and C libraries write.
    """
    python = io.StringIO()
    with tempfile.TemporaryFile() as native, _descriptor_2(native.fileno()), _python_stderr(python):
        try:
            yield
        finally:
            native.seek(0)
            captured = native.read().decode(errors="replace") + python.getvalue()
            if captured:
                print(captured if len(captured) <= LIMIT else captured[:LIMIT] + "\n... and so on")


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
    # Logging handlers may reference the original object, so its methods are replaced, too. The flush of a
    # notebook's stream waits for a thread, which in a run would be a wait in simulated time.
    attributes = getattr(original, "__dict__", {})
    before = {name: attributes.pop(name) for name in ("write", "flush") if name in attributes}
    sys.stderr = target
    attributes.update(write=target.write, flush=target.flush)
    try:
        yield
    finally:
        sys.stderr = original
        del attributes["write"], attributes["flush"]
        attributes.update(before)
