"""A progress bar below a cell, which disappears at the end."""

from __future__ import annotations

from html import escape

from IPython.display import HTML, DisplayHandle, display


class ProgressBar:
    """A bar with a text. most: where it is full."""

    def __init__(self, most: int) -> None:
        self._most = most
        self._handle: DisplayHandle | None = None

    def show(self, text: str, done: int) -> None:
        """Show a text, and how much is done."""
        bar = HTML(f"<label><progress max='{self._most}' value='{done}'></progress> {escape(text)}</label>")
        if self._handle is None:
            self._handle = display(bar, display_id=True)
        else:
            self._handle.update(bar)

    def end(self) -> None:
        """Remove it."""
        if self._handle is not None:
            self._handle.update(HTML(""))
            self._handle = None
