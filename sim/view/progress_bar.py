"""A progress bar below a cell; at the end a line says how much was done."""

from __future__ import annotations

from html import escape

from IPython.display import HTML, DisplayHandle, display


class ProgressBar:
    """A bar with a text. most: where it is full."""

    def __init__(self, most: int) -> None:
        self._most, self._done = most, 0
        self._handle: DisplayHandle | None = None

    def show(self, text: str, done: int) -> None:
        """Show a text, and how much is done."""
        self._done = done
        bar = HTML(f"<label><progress max='{self._most}' value='{done}'></progress> {escape(text)}</label>")
        if self._handle is None:
            self._handle = display(bar, display_id=True)
        else:
            self._handle.update(bar)

    def end(self) -> None:
        """Replace the bar with the number."""
        if self._handle is not None:
            self._handle.update(HTML(f"<small>Orders tried: {self._done}</small>"))
            self._handle = None
