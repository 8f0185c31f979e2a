"""Which cell's output contains a script that all pictures of a notebook use, so that each is there once."""

from __future__ import annotations


class SharedScripts:
    """The carriers of scripts: the output of one cell contains a script, and later outputs only call it.

    A cell that runs again loses its output; then the next output with a picture carries the script. The same
    holds if the carrier was deleted, as far as the page has sent its cells.
    """

    def __init__(self) -> None:
        self._carriers: dict[str, str] = {}  # script: cell
        self._running = ""

    def begin(self, cell: str) -> None:
        """A cell starts to run: it carries no script any more."""
        self._running = cell
        self._carriers = {script: by for script, by in self._carriers.items() if by != cell}

    def update(self, order: list[str]) -> None:
        """The page has these cells."""
        self._carriers = {script: by for script, by in self._carriers.items() if by in order}

    def is_needed(self, script: str) -> bool:
        """Return whether the next output must contain this script; if so, the running cell now carries it."""
        if script in self._carriers:
            return False
        if self._running:
            self._carriers[script] = self._running
        return True
