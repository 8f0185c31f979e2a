"""The comm to the page that shows the notebook, if it has the course's JupyterLab extension (jupyter/).

The page sends the sources of the cells; the kernel sends the content of the panel beside the notebook.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

TARGET = "ros2-course"
MAX_CELLS, MAX_CHARACTERS = 2_000, 1_000_000


class PageComm:
    """A comm to the page. Before `open`, and without the extension, sent data is discarded."""

    def __init__(self) -> None:
        self._comm: Any = None
        self._bundle: dict[str, Any] = {}
        self._on_cells: Callable[[list[str], dict[str, str]], None] = lambda order, texts: None

    def open(self, on_cells: Callable[[list[str], dict[str, str]], None]) -> None:
        """Open the comm. on_cells: called with the ids of all cells in order, and the changed sources."""
        try:
            from comm import create_comm  # imported here because it requires a kernel
        except ImportError:  # an old kernel, as in some notebook services, which don't have the extension
            return
        self._on_cells = on_cells
        self._comm = create_comm(target_name=TARGET, data={})
        self._comm.on_msg(self._on_message)

    def show(self, bundle: dict[str, Any]) -> None:
        """Show a MIME bundle in the panel beside the notebook, also after a reload of the page."""
        self._bundle = bundle
        self._send()

    def _send(self) -> None:
        if self._comm is not None:
            self._comm.send({"show": self._bundle})

    def _on_message(self, message: dict[str, Any]) -> None:
        match message["content"]["data"]:
            case {"hello": True}:
                if self._bundle:
                    self._send()
            case {"order": list(order), "texts": dict(texts)} if len(order) <= MAX_CELLS:
                if all(map(_is_text, (*order, *texts.values()))):
                    self._on_cells(order, texts)


def _is_text(value: Any) -> bool:
    return isinstance(value, str) and len(value) <= MAX_CHARACTERS
