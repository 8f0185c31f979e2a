"""The notebook around the runs: its cells, what they define, and the page that shows it."""

from sim.notebook.kernel import (
    Interrupted,
    LastVersionDidNotRun,
    Outdated,
    in_notebook,
    missing,
    notebook_page,
    outdated,
    refuse_outdated,
    show_error,
    watch,
)

__all__ = [
    "Interrupted",
    "LastVersionDidNotRun",
    "Outdated",
    "in_notebook",
    "missing",
    "notebook_page",
    "outdated",
    "refuse_outdated",
    "show_error",
    "watch",
]
