"""The notebook around the runs: its cells, what they define, and the page that shows it."""

from sim.notebook.kernel import Interrupted, Outdated, in_notebook, notebook_page, outdated, refuse_outdated, watch

__all__ = ["Interrupted", "Outdated", "in_notebook", "notebook_page", "outdated", "refuse_outdated", "watch"]
