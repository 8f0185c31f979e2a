"""The line to the page that shows the notebook, if that is our JupyterLab; jupyter/ has its other end.

The page tells the texts of the cells; the kernel tells what the panel beside the notebook is to show.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

TARGET = "ros2-course"
MOST_CELLS, MOST_TEXT = 2_000, 1_000_000


class Page:
    """Before `open`, and where nobody answers, what it is told goes nowhere."""

    def __init__(self) -> None:
        self._comm: Any = None
        self._shown: dict[str, Any] = {}
        self._cells: Callable[[list[str], dict[str, str]], None] = lambda order, texts: None

    def open(self, cells: Callable[[list[str], dict[str, str]], None]) -> None:
        """Call the page. cells: is given the ids of the notebook's cells in order, and texts that changed."""
        from comm import create_comm  # here, for without a kernel there is none

        self._cells = cells
        self._comm = create_comm(target_name=TARGET, data={})
        self._comm.on_msg(self._heard)

    def show(self, bundle: dict[str, Any]) -> None:
        """Have this in the panel beside the notebook; a page that is loaded again finds it there."""
        self._shown = bundle
        self._send()

    def _send(self) -> None:
        if self._comm is not None:
            self._comm.send({"show": self._shown})

    def _heard(self, message: dict[str, Any]) -> None:
        match message["content"]["data"]:
            case {"hello": True}:
                if self._shown:
                    self._send()
            case {"order": list(order), "texts": dict(texts)} if len(order) <= MOST_CELLS:
                if all(
                    isinstance(text, str) and len(text) <= MOST_TEXT for text in (*order, *texts.values())
                ):
                    self._cells(order, texts)
