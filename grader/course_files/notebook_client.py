"""A client that runs a notebook's cells in a kernel."""

from typing import Any

from nbclient import NotebookClient
from nbformat import NotebookNode

KERNEL_START = OUTPUT_LATE = 600  # s, only against hanging; after the latter nbclient reads no further output


def notebook_client(notebook: NotebookNode, seconds: float, **options: Any) -> NotebookClient:
    """A client that runs a notebook with a time limit for each cell, even if cells raise, without widgets.

    While nbclient answers a widget's messages, it may miss that the cell is done, and wait until the limit.
    """
    options = {"kernel_name": "python3", "allow_errors": True, "startup_timeout": KERNEL_START, **options}
    client = NotebookClient(notebook, timeout=seconds, iopub_timeout=OUTPUT_LATE, **options)
    client.comm_open_handlers.clear()
    return client
