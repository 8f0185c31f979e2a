"""What a program reads from stdin: the lines it was given, for in a run nobody types."""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import TextIO


def keyboard(lines: Sequence[str] | None) -> TextIO:
    """The stdin of a program that is given these lines; None: it is not expected to read any."""
    return _Nobody() if lines is None else io.StringIO("".join(f"{line}\n" for line in lines))


class _Nobody(io.TextIOBase):
    """Refuses to be read, where a robot's terminal would wait for ever."""

    def read(self, size: int | None = -1, /) -> str:
        """As `TextIO.read`. Raises RuntimeError."""
        raise RuntimeError(
            "input() waits for somebody at the keyboard; give it lines, as in run(Process(main, "
            'stdin=["first line", "second line"])), or let the node get its input from topics and parameters'
        )

    readline = read
