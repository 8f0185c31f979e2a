"""What the cells of a student's process show, on its way to the judge."""

from __future__ import annotations

import contextlib
import signal
import threading
from collections.abc import Iterator
from typing import Any

from grader.marking.outputs import LEFT_OUT, MOST, output_size, writable_text
from sim.ros.remote import Wire

AT_ONCE = 500  # pieces of text of one cell that go out as they come: so a crash loses none of them
PIECE = 20_000  # characters that are gathered after that
SIGNALS = {signal.SIGINT, signal.SIGALRM}  # their handlers may raise; half a message would break the wire


class Outlet:
    """Sends outputs in order. Past what the judge takes from one cell, it sends no more.

    Any thread may write.
    """

    most = 2 * MOST  # characters; the judge cuts, and says so

    def __init__(self, wire: Wire) -> None:
        self._wire = wire
        self._lock = threading.RLock()
        self._text, self._name = "", "stdout"
        self._kept: list[dict[str, Any]] | None = None  # while the wire is somebody else's
        self.begin()

    def begin(self) -> None:
        """A new cell."""
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
        """Send the text that was gathered."""
        with self._lock:
            text, self._text = self._text, ""
            if text:
                self._pieces += 1
                self._send({"output": _stream(self._name, text)})

    @contextlib.contextmanager
    def closed(self) -> Iterator[None]:
        """For a while nothing goes out: the wire is needed for something else. Then all of it does."""
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
        """Say that the cell is over, behind all that it showed."""
        with self._lock:
            self.flush()
            self._wire.send(done=True, **claims)

    def _send(self, event: dict[str, Any]) -> None:
        output = event.get("output", {})
        if output_size(output) > MOST:
            event = {**event, "output": _stream("stdout", LEFT_OUT)}
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
