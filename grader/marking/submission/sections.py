"""The sections of an assignment's notebook: one for each exercise, from its heading on."""

from collections.abc import Sequence

from nbformat import NotebookNode

SECTION = "## "


def section_around(cells: Sequence[NotebookNode], at: int) -> range:
    """The indices of the cells from the heading above a cell to the next one below."""
    heads = [index for index, cell in enumerate(cells) if cell.source.startswith(SECTION)]
    start = max((index for index in heads if index <= at), default=0)
    return range(start, min((index for index in heads if index > at), default=len(cells)))
