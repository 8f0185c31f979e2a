"""What student code writes to stdout and stderr during a run, kept apart by who writes."""

from __future__ import annotations

import contextlib
import os
import sys
import tempfile
from collections.abc import Callable, Iterator
from typing import Any, TextIO

from sim.ros.fibers import engine


class StudentStream:
    """Stands for a text stream during a run: student code writes to `write`, all others to the original."""

    def __init__(self, original: TextIO, write: Callable[[str], None]) -> None:
        self._original, self._write = original, write

    def write(self, text: str) -> int:
        """As `TextIO.write`."""
        if engine() is None:
            return self._original.write(text)
        self._write(text)
        return len(text)

    def writelines(self, lines: Any) -> None:
        """As `TextIO.writelines`."""
        for line in lines:
            self.write(line)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._original, name)


@contextlib.contextmanager
def student_streams(on_stdout: Callable[[str], None], on_stderr: Callable[[str], None]) -> Iterator[None]:
    """Redirect Python's stdout and stderr for the time of a run."""
    stdout, stderr = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = StudentStream(stdout, on_stdout), StudentStream(stderr, on_stderr)
    # Handlers of Python's logging hold on to the stream object itself.
    held = vars(stderr) if hasattr(stderr, "__dict__") else None
    if held is not None:
        held["write"] = StudentStream(_Unbound(stderr), on_stderr).write
    try:
        yield
    finally:
        if held is not None:
            held.pop("write", None)
        sys.stdout, sys.stderr = stdout, stderr


class _Unbound:
    """A stream's own class's `write`, past what is set on the object."""

    def __init__(self, stream: Any) -> None:
        self._stream = stream

    def write(self, text: str) -> int:
        return type(self._stream).write(self._stream, text)


@contextlib.contextmanager
def file_descriptor_2(on_text: Callable[[str], None]) -> Iterator[None]:
    """Catch what is written to file descriptor 2 below Python, as ROS's C libraries do."""
    with contextlib.suppress(Exception):
        sys.stderr.flush()
    saved = os.dup(2)
    with tempfile.TemporaryFile() as sink:
        os.dup2(sink.fileno(), 2)
        try:
            yield
        finally:
            with contextlib.suppress(Exception):
                sys.stderr.flush()
            os.dup2(saved, 2)
            os.close(saved)
            sink.seek(0)
            on_text(sink.read(1_000_000).decode(errors="replace"))
