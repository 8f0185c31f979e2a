"""Captures what student code writes to stdout and stderr during a run, apart from what others write."""

from __future__ import annotations

import contextlib
import os
import re
import sys
import tempfile
from collections.abc import Iterable, Iterator
from types import SimpleNamespace
from typing import Any, TextIO

from sim.ros.fibers.scheduler import engine, outside_student_code

ECHO_LINES = 100  # shown of what nodes log and print; the recording has all of it
ECHO_CHARACTERS = 20_000
# rclpy's warnings about QoS are in the recording, and `tell` explains them.
RAW_QOS = re.compile(r"\[WARN\] .*: New (publisher|subscription) discovered on topic .* incompatible QoS\.")


class StudentStream:
    """Replaces a text stream during a run: student code writes to the run, all others to the original.

    It has no reference to a run, because a library that is first imported in a run may store it forever.
    """

    def __init__(self, original: Any, channel: str) -> None:
        self._original, self._channel = original, channel

    def write(self, text: str) -> int:
        """Work like `TextIO.write`."""
        run = engine()
        if run is None:
            return self._original.write(text)
        getattr(run.output, self._channel)(text)
        return len(text)

    def flush(self) -> None:
        """Work like `TextIO.flush`; a notebook's stream would wait for a thread, which a fiber can't do."""
        if engine() is None:
            self._original.flush()

    def close(self) -> None:
        """Does nothing: the stream is the kernel's, not the student's."""

    def writelines(self, lines: Iterable[str]) -> None:
        """Work like `TextIO.writelines`."""
        for line in lines:
            self.write(line)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._original, name)


_streams: dict[str, StudentStream] = {}  # the last ones, by channel


def _student_stream(original: Any, channel: str) -> StudentStream:
    """The same for the same original: print() in another thread may still be using it when a run is over, and
    Python can crash if it is gone by then.
    """
    last = _streams.get(channel)
    if last is None or last._original is not original:
        _streams[channel] = last = StudentStream(original, channel)
    return last


@contextlib.contextmanager
def student_streams() -> Iterator[None]:
    """Redirect Python's stdout and stderr for the time of a run to its `output`."""
    stdout, stderr = sys.stdout, sys.stderr
    sys.stdout = _student_stream(stdout, "stdout")
    sys.stderr = _student_stream(stderr, "stderr")
    redirected = _redirect(stdout, "stdout")
    if stderr is not stdout:  # both may be one
        redirected += _redirect(stderr, "stderr")
    try:
        yield
    finally:
        for stream, name in redirected:
            delattr(stream, name)
        sys.stdout, sys.stderr = stdout, stderr


def _redirect(stream: TextIO, channel: str) -> list[tuple[TextIO, str]]:
    """Redirect the stream object itself if it allows that: handlers of Python's logging have stored it."""
    try:
        original = SimpleNamespace(write=stream.write, flush=stream.flush)
        student = StudentStream(original, channel)
        stream.write, stream.flush = student.write, student.flush
    except AttributeError:  # None, or a stream of Python's own, which waits for no thread
        return []
    return [(stream, "write"), (stream, "flush")]


class FileDescriptor2:
    """Captures what is written to file descriptor 2 below Python, as ROS's C libraries do."""

    def __init__(self) -> None:
        self._sink = tempfile.TemporaryFile()  # noqa: SIM115  (close() does)

    @contextlib.contextmanager
    def captured(self) -> Iterator[None]:
        """Capture in this block."""
        _flush()
        users = os.dup(2)
        os.dup2(self._sink.fileno(), 2)
        try:
            yield
        finally:
            _flush()
            os.dup2(users, 2)
            os.close(users)

    def close(self) -> str:
        """All that was captured, or the first megabyte of it."""
        with self._sink:
            self._sink.seek(0)
            return self._sink.read(1_000_000).decode(errors="replace")


def _flush() -> None:
    with contextlib.suppress(Exception):
        sys.stderr.flush()


class Screen:
    """Shows the first lines of what nodes log and print, on stdout: on stderr, nbgrader sees a failure."""

    def __init__(self, quiet: bool) -> None:
        self.quiet, self.stream = quiet, sys.stdout
        self.lines = self.characters = 0

    def __call__(self, text: str) -> None:
        """Show some more, if there is room."""
        if RAW_QOS.match(text):
            return
        if not self.quiet and self.lines < ECHO_LINES and self.characters < ECHO_CHARACTERS:
            with outside_student_code():
                self.stream.write(text[:ECHO_CHARACTERS])
        self.lines += text.count("\n")
        self.characters += len(text)

    def close(self) -> None:
        """Show how much was left out."""
        if not self.quiet and self.lines > ECHO_LINES:
            self.stream.write(f"... and {self.lines - ECHO_LINES} more lines, all in the recording\n")
