"""The notebook around the runs: its cells, what they define, and the page that shows it."""

from sim.notebook.kernel import (
    LastVersionDidNotRun,
    Outdated,
    in_notebook,
    interrupted,
    missing,
    notebook_page,
    outdated,
    refuse_outdated,
    show_error,
    watch,
)

__all__ = [
    "LastVersionDidNotRun",
    "Outdated",
    "in_notebook",
    "interrupted",
    "missing",
    "notebook_page",
    "outdated",
    "refuse_outdated",
    "show_error",
    "watch",
]
