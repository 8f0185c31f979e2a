"""Hooks of `nbgrader validate`: they name a cell that it stopped, also in the errors of the cells below."""

from typing import Any

from nbformat import NotebookNode
from nbformat.v4 import new_output

TIMEOUT = "CellTimeoutError"
# nbgrader cuts off the end of a line that is longer than about 80 characters.
STOPPED = "Validate stopped a cell that ran longer than its time limit. It begins with:\n    {}"
MISSING = "\nWhat that cell defines can be missing below it. Marking allows more time."

_stopped: list[str] = []  # the sentence about the last such cell of this notebook


def begin(cell: NotebookNode, cell_index: int) -> None:
    """Forget the previous notebook. For `on_cell_start` of nbclient."""
    if cell_index == 0:
        _stopped.clear()


def explain(cell: NotebookNode, cell_index: int, execute_reply: dict[str, Any]) -> None:
    """Add the sentence to the errors of a cell. For `on_cell_error` of nbclient."""
    if execute_reply["content"]["ename"] == TIMEOUT:
        _stopped[:] = [STOPPED.format(next(iter(cell.source.strip().splitlines()), ""))]
    for sentence in _stopped:
        cell.outputs.insert(0, new_output("error", ename=TIMEOUT, evalue="", traceback=[sentence + MISSING]))
