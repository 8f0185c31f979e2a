"""Runs a notebook in its folder, by any Python that has nbclient: run_notebook.py NOTEBOOK

Prints JSON: the errors of its cells, and all the text of its outputs.
"""

import json
import re
import sys
from pathlib import Path

import nbformat
from nbclient import NotebookClient

SECONDS = 600  # for a cell, only against hanging


def main(path: Path) -> None:
    """Run the notebook, even if cells raise, and print what it showed."""
    notebook = nbformat.read(path, 4)
    patience = dict.fromkeys(("timeout", "startup_timeout", "iopub_timeout"), SECONDS)
    client = NotebookClient(notebook, kernel_name="python3", allow_errors=True, **patience)
    client.comm_open_handlers.clear()  # while it answers widgets it may miss that a cell is done
    client.execute(cwd=str(path.parent))
    errors, texts = [], []
    for cell in notebook.cells:
        for output in cell.get("outputs", ()):
            if output.output_type == "error":
                errors.append(f"{cell.id}: {output.ename}: {output.evalue}")
            texts += [output.get("text", ""), output.get("data", {}).get("text/html", "")]
    print(json.dumps({"errors": errors, "text": re.sub(r"<[^>]*>", "", "\n".join(texts))}))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
