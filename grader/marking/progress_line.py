"""Shows progress, as of marking: one changing line on a terminal, one line for each submission elsewhere."""
import shutil
import sys
import time
from collections.abc import Callable
from typing import TextIO

from grader.marking.result import Result

CLEAR = "\r\x1b[K"


def printable(text: str) -> str:
    """The text without control characters, which a submission may have put there."""
    return "".join(letter if letter.isprintable() else " " for letter in text)


class ProgressLine:
    """The progress of marking `total` submissions, of which some may be marked already."""

    def __init__(
        self, total: int, stream: TextIO | None = None, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._total, self._stream, self._clock = total, stream or sys.stderr, clock
        self._begin, self._done, self._skipped = clock(), 0, 0
        self._is_terminal = self._stream.isatty()

    def add_result(self, result: Result) -> None:
        """Show that a submission is marked."""
        most = sum(cell.max for notebook in result.notebooks for cell in notebook.cells)
        points = f"{result.points:g} of {most:g} points, {result.verdict}"
        self.add_line(f"{result.student}: {points if result.verdict != 'broken' else 'could not be judged'}")

    def skip(self) -> None:
        """Count one that is marked already, and show nothing."""
        self._skipped += 1

    def add_line(self, text: str, count: int = 1) -> None:
        """Show that `count` more are done."""
        self._done += count
        text = printable(text)
        done = f"{self._done + self._skipped} of {self._total}"
        if not self._is_terminal:
            print(f"{done}  {text}", file=self._stream, flush=True)
            return
        rate = self._done / max(self._clock() - self._begin, 1e-3)
        left = _duration((self._total - self._skipped - self._done) / rate)
        line = f"{done}, {rate:.2g} each second, {left} left  {text}"
        width = shutil.get_terminal_size().columns - 1
        print(CLEAR + line[:width], end="", file=self._stream, flush=True)

    def close(self) -> None:
        """Clear the line that changes."""
        if self._is_terminal:
            print(CLEAR, end="", file=self._stream, flush=True)


def _duration(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"
