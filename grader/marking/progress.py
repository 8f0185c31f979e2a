"""Says how far marking is: one line that changes on a terminal, one line for each submission elsewhere."""
import shutil
import sys
import time
from collections.abc import Callable
from typing import TextIO

from grader.marking.result import Result

CLEAR = "\r\x1b[K"


def printable(words: str) -> str:
    """The words without what a terminal would obey: a submission may have put it there."""
    return "".join(letter if letter.isprintable() else " " for letter in words)


class Progress:
    """How far the marking of `total` submissions is."""

    def __init__(
        self, total: int, stream: TextIO | None = None, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._total, self._stream, self._clock = total, stream or sys.stderr, clock
        self._begin, self._done = clock(), 0
        self._lively = self._stream.isatty()

    def done(self, result: Result) -> None:
        """Say that a submission is marked."""
        most = sum(cell.max for notebook in result.notebooks for cell in notebook.cells)
        self.tell(f"{result.student}: {result.points:g} of {most:g} points, {result.verdict}")

    def tell(self, said: str) -> None:
        """Say that one more is done."""
        self._done += 1
        said = printable(said)
        count = f"{self._done} of {self._total}"
        if not self._lively:
            print(f"{count}  {said}", file=self._stream, flush=True)
            return
        rate = self._done / max(self._clock() - self._begin, 1e-3)
        left = _duration((self._total - self._done) / rate)
        line = f"{count}, {rate:.2g} each second, {left} left  {said}"
        width = shutil.get_terminal_size().columns - 1
        print(CLEAR + line[:width], end="", file=self._stream, flush=True)

    def close(self) -> None:
        """Clear the line that changes."""
        if self._lively:
            print(CLEAR, end="", file=self._stream, flush=True)


def _duration(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"
