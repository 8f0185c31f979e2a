"""Wall time of every test cell in the solution notebooks, run in a kernel."""

from datetime import datetime
from pathlib import Path

import nbformat
from nbclient import NotebookClient

from tests.bench.report import table

SOLUTIONS = Path("solutions")


def graded_cells(notebook: Path) -> list[list[object]]:
    """Name, points and wall time (s) of each test cell, after the whole notebook has run."""
    content = nbformat.read(notebook, as_version=4)
    folder = {"metadata": {"path": str(notebook.parent)}}
    client = NotebookClient(content, timeout=120, record_timing=True, resources=folder)
    client.extra_arguments = ["--log-level=40"]  # errors only
    client.execute()
    found = []
    for cell in content.cells:
        nbgrader = cell.metadata.get("nbgrader", {})
        if cell.cell_type == "code" and nbgrader.get("grade"):
            begin, end = (
                datetime.fromisoformat(cell.metadata.execution[moment])
                for moment in ("iopub.execute_input", "shell.execute_reply")
            )
            found.append([nbgrader["grade_id"], nbgrader["points"], (end - begin).total_seconds()])
    return found


def main() -> None:
    """Time them all."""
    rows, total = [], 0.0
    for notebook in sorted(SOLUTIONS.glob("*/*.ipynb")):
        for name, points, seconds in graded_cells(notebook):
            total += seconds
            rows.append([f"{notebook.stem}: {name}", points, f"{seconds:.2f}"])
    if not rows:
        print(f"no graded notebook in {SOLUTIONS}/")
        return
    table(["exercise", "points", "s"], rows)
    print(f"{len(rows)} exercises in {total:.1f} s: {len(rows) / total:.1f} a second")


if __name__ == "__main__":
    main()
