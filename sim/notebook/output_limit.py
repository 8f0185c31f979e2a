"""Limits what one cell shows, so that an endless loop can't overload the page; the rest is counted.

It imports no other module of the course: a kernel of `make lab` loads this file before anything else.
"""

from __future__ import annotations

import sys
from typing import Any

LINES = 2_000
CHARACTERS = 200_000
OVERWRITTEN = 10 * CHARACTERS  # with the text that a progress bar has overwritten
DISPLAYS = 300
CLEARS = 10_000  # of an animation that clears the output for each picture
CELLS = 50  # whose counts are stored: threads of earlier cells may still print
TOO_MUCH = "... A page can't show more output. The rest is only counted; ■ stops the cell.\n"


class CellOutput:
    """Counts what one execution of a cell shows, and what is hidden."""

    def __init__(self) -> None:
        self._clears = self._sent = 0
        self.clear()
        self._hidden_lines = self._hidden_characters = self._hidden_displays = 0

    def clear(self) -> bool:
        """Count from 0 again, because the page removes the output; return whether it still may."""
        self._clears += 1
        if self._clears > CLEARS:
            return False
        self._lines = self._characters = self._displays = 0
        self._line = 0  # characters of the unfinished line
        self._full = False
        return True

    def fit(self, text: str) -> str:
        """Count a text, and return the part of it that is shown.

        A progress bar returns to the start of its line, so the text that it overwrites doesn't count.
        """
        shown = "" if self._full else self._shown_part(text)
        rest = len(text) - len(shown)
        self._hidden_lines += text.count("\n", len(shown))
        self._hidden_characters += rest
        if self._full or not rest:
            return shown
        self._full = True
        return shown + ("\n" if self._line else "") + TOO_MUCH

    def allows_display(self) -> bool:
        """Count a displayed object, and return whether it is shown."""
        self._displays += 1
        self._hidden_displays += self._displays > DISPLAYS
        return self._displays <= DISPLAYS

    def hidden(self) -> str:
        """Return a sentence on what was not shown; "" if everything was."""
        lines, characters = self._hidden_lines, self._hidden_characters
        text = f"{lines:,} more lines" if lines > 1 else f"{characters:,} more characters"
        texts = [text] if characters else []
        texts += [f"{self._hidden_displays:,} more outputs"] if self._hidden_displays else []
        return f"... and {' and '.join(texts)}.\n" if texts else ""

    def _shown_part(self, text: str) -> str:
        lines = text.splitlines(keepends=True)
        room = min(CHARACTERS - self._characters, OVERWRITTEN - self._sent)
        shown = "".join(lines[: LINES - self._lines])[:room]
        self._sent += len(shown)
        first, *rest = shown.split("\n")
        self._count_line(first)
        for line in rest:
            self._lines, self._line = self._lines + 1, 0
            self._count_line(line)
        return shown

    def _count_line(self, text: str) -> None:
        """Count text that continues the unfinished line."""
        _, overwrites, text = text.removesuffix("\r").rpartition("\r")
        if overwrites:
            self._characters -= self._line
            self._line = 0
        self._characters += len(text)
        self._line += len(text)


class OutputLimit:
    """Limits the streams, displays and results of an IPython kernel. shell: its InteractiveShell."""

    def __init__(self, shell: Any) -> None:
        self._cells: dict[str, CellOutput] = {}
        self._last: Any = sys.stdout  # the stream that showed or hid something last
        self._limit_stream(sys.stdout)
        self._limit_stream(sys.stderr)
        self._limit_displays(shell.display_pub)
        self._limit_result(shell.displayhook)
        shell.events.register("post_run_cell", lambda result: self._finish())

    def _output(self, source: Any) -> CellOutput:
        """Return the counts of the cell to which a stream or publisher adds output now."""
        cell = source.parent_header.get("msg_id", "")
        if cell not in self._cells:
            self._cells[cell] = CellOutput()
            if len(self._cells) > CELLS:
                self._cells.pop(next(iter(self._cells)), None)
        return self._cells[cell]

    def _limit_stream(self, stream: Any) -> None:
        write = stream.write

        def limited(text: str) -> int | None:
            if not isinstance(text, str):
                return write(text)  # the stream's own error
            self._last = stream
            shown = self._output(stream).fit(text)
            if shown:
                write(shown)
            return len(text)

        stream.write = limited
        stream.write_unlimited = write

    def _limit_displays(self, publisher: Any) -> None:
        publish, clear_output = publisher.publish, publisher.clear_output

        def limited(data: dict[str, Any], *args: Any, **options: Any) -> None:
            if options.get("update") or self._output(publisher).allows_display():
                publish(shorten(data), *args, **options)

        def cleared(*args: Any, **options: Any) -> None:
            if self._output(publisher).clear():
                clear_output(*args, **options)

        publisher.publish, publisher.clear_output = limited, cleared

    def _limit_result(self, hook: Any) -> None:
        write = hook.write_format_data
        hook.write_format_data = lambda data, metadata=None: write(shorten(data), metadata)

    def _finish(self) -> None:
        """Show what the cell that has finished didn't show."""
        hidden = self._output(self._last).hidden()
        if hidden:
            self._last.write_unlimited(hidden)


def limit_output(shell: Any) -> None:
    """Limit the output of a kernel. Idempotent. shell: its InteractiveShell."""
    if hasattr(sys.stdout, "parent_header") and not hasattr(sys.stdout, "write_unlimited"):
        OutputLimit(shell)


def shorten(data: dict[str, Any]) -> dict[str, Any]:
    """Return a MIME bundle whose plain text has at most `CHARACTERS` characters."""
    text = data.get("text/plain", "")
    more = len(text) - CHARACTERS
    if more <= 0:
        return data
    return {**data, "text/plain": f"{text[:CHARACTERS]}\n... and {more:,} more characters"}
