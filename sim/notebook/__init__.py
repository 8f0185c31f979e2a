"""The notebook around a run: the history of its cells, and the connection to its page."""

from sim.notebook.kernel import (
    OutdatedCodeError,
    OutdatedName,
    explain_missing_name,
    find_outdated,
    in_notebook,
    interrupt_error,
    notebook_page,
    raise_if_outdated,
    show_error,
    watch_cells,
)

__all__ = [
    "OutdatedCodeError",
    "OutdatedName",
    "explain_missing_name",
    "find_outdated",
    "in_notebook",
    "interrupt_error",
    "notebook_page",
    "raise_if_outdated",
    "show_error",
    "watch_cells",
]
