"""The notebook around a run: the history of its cells, and the connection to its page."""

from sim.notebook.failure_report import failure_html, failure_lines, is_reported, name_cell, report_failure
from sim.notebook.kernel import (
    OutdatedCodeError,
    OutdatedName,
    explain_missing_name,
    find_outdated,
    in_notebook,
    interrupt_error,
    notebook_page,
    raise_if_outdated,
    shared_scripts,
    show_error,
    watch_cells,
)

__all__ = [
    "OutdatedCodeError",
    "OutdatedName",
    "explain_missing_name",
    "failure_html",
    "failure_lines",
    "find_outdated",
    "in_notebook",
    "interrupt_error",
    "is_reported",
    "name_cell",
    "notebook_page",
    "raise_if_outdated",
    "report_failure",
    "shared_scripts",
    "show_error",
    "watch_cells",
]
