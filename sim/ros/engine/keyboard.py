"""What a program reads from stdin: the lines that it was given, because a run has no keyboard."""

from __future__ import annotations

import io
from collections.abc import Sequence


def keyboard(lines: Sequence[str] | None) -> io.TextIOBase:
    """The stdin of a program that is given these lines; None: it is not expected to read any."""
    return _NoInput() if lines is None else _Lines("".join(f"{line}\n" for line in lines))


class _NoTerminal(io.TextIOBase):
    def fileno(self) -> int:
        """Work like `TextIO.fileno`. Raises UnsupportedOperation."""
        raise io.UnsupportedOperation(
            "a run has no terminal whose keys can be read one by one; give the program lines, as in "
            'run(Process(main, stdin=["first line", "second line"])) for input(), or drive in the picture of '
            "play()"
        )


class _Lines(_NoTerminal, io.StringIO):
    pass


class _NoInput(_NoTerminal):
    """Raises when it is read, where a robot's terminal would wait forever."""

    def read(self, size: int | None = -1, /) -> str:
        """Work like `TextIO.read`. Raises RuntimeError."""
        raise RuntimeError(
            "input() waits for a person at the keyboard; give it lines, as in run(Process(main, "
            'stdin=["first line", "second line"])), or let the node get its input from topics and parameters'
        )

    readline = read
