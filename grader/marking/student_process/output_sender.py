"""Sends what the cells of a student's process show to the judge."""

from __future__ import annotations

import contextlib
import signal
import threading
from collections.abc import Iterator
from typing import Any

from grader.marking.outputs import MAX_CELL_CHARS, TRUNCATED, output_size, writable_text
from sim.ros.remote import Wire

AT_ONCE = 500  # pieces of text of one cell that are sent at once, so that a crash loses none of them
PIECE = 20_000  # characters that are buffered after that
SIGNALS = {signal.SIGINT, signal.SIGALRM}  # their handlers may raise; a partial message would break the wire


class OutputSender:
    """Sends outputs in order, up to a limit for each cell. Thread-safe."""

    most = 2 * MAX_CELL_CHARS  # of one cell; the judge truncates earlier, and reports it

    def __init__(self, wire: Wire) -> None:
        self._wire = wire
        self._lock = threading.RLock()
        self._text, self._name = "", "stdout"
        self._kept: list[dict[str, Any]] | None = None  # the events while paused
        self.begin()

    def begin(self) -> None:
        """Start a new cell."""
        self._sent = self._pieces = 0

    def write(self, name: str, text: str) -> None:
        """Show text on stdout or stderr."""
        with self._lock:
            if name != self._name:
                self.flush()
                self._name = name
            self._text += writable_text(text[: self.most])
            if self._pieces < AT_ONCE or len(self._text) >= PIECE:
                self.flush()

    def show(self, **event: Any) -> None:
        """Show an output, or change one: what `CellOutputs.add` takes."""
        with self._lock:
            self.flush()
            self._send(event)

    def flush(self) -> None:
        """Send the buffered text."""
        with self._lock:
            text, self._text = self._text, ""
            if text:
                self._pieces += 1
                self._send({"output": _stream(self._name, text)})

    @contextlib.contextmanager
    def paused(self) -> Iterator[None]:
        """Keep events inside, because the wire is used otherwise, and send them afterwards."""
        with self._lock:
            self.flush()
            self._kept = []
        try:
            yield
        finally:
            with self._lock:
                kept, self._kept = self._kept, None
                for event in kept:
                    self._send(event)

    def done(self, **claims: Any) -> None:
        """Report that the cell is over, after all its outputs."""
        with self._lock:
            self.flush()
            self._wire.send(done=True, **claims)

    def _send(self, event: dict[str, Any]) -> None:
        output = event.get("output", {})
        if output_size(output) > MAX_CELL_CHARS:
            event = {**event, "output": _stream("stdout", TRUNCATED)}
        if self._sent > self.most:
            return
        self._sent += output_size(output)
        if self._kept is not None:
            self._kept.append(event)
            return
        unblocked = signal.pthread_sigmask(signal.SIG_BLOCK, SIGNALS)
        try:
            self._wire.send(**event)
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, unblocked)


def _stream(name: str, text: str) -> dict[str, Any]:
    return {"output_type": "stream", "name": name, "text": text}
