"""A tiny course, for tests: its exercises need no robot."""
import functools
import shutil
from pathlib import Path

import nbformat
from nbgrader import api

ROOT = Path(__file__).parents[2]
# For every new gradebook, nbgrader asks a process of its own, which takes seconds to say the same each time.
api.get_alembic_version = functools.cache(api.get_alembic_version)
WARN = "import logging, os; logging.warning('from Python'); os.write(2, b'from C')"


def answer(grade_id: str, source: str) -> nbformat.NotebookNode:
    return _cell(grade_id, source, solution=True, locked=False, grade=False)


def grade(grade_id: str, points: float, source: str) -> nbformat.NotebookNode:
    return _cell(grade_id, source, solution=False, locked=True, grade=True, points=points)


def _cell(grade_id: str, source: str, **nbgrader: object) -> nbformat.NotebookNode:
    metadata = {"grade_id": grade_id, "schema_version": 3, "task": False, "cell_type": "code", **nbgrader}
    return nbformat.v4.new_code_cell(source, id=grade_id, metadata={"nbgrader": metadata})


def course(folder: Path, *cells: nbformat.NotebookNode) -> Path:
    """Write a course with one assignment, 01_tiny, of these cells and with the real configuration."""
    folder.mkdir(exist_ok=True)
    shutil.copy(ROOT / "nbgrader_config.py", folder)
    source = folder / "solutions" / "01_tiny" / "tiny.ipynb"
    source.parent.mkdir(parents=True)
    nbformat.write(nbformat.v4.new_notebook(cells=list(cells)), source)
    return folder


def tiny(folder: Path, *more: nbformat.NotebookNode) -> Path:
    """Write a course whose exercises give 2, 3 and 1 points; the last one writes to stderr, twice.

    more: cells before them.
    """
    return course(
        folder,
        *more,
        answer("double", "def double(x):\n    ### BEGIN SOLUTION\n    return x + x\n    ### END SOLUTION"),
        grade("test_double", 2, "assert double(3) == 6"),
        answer("triple", "def triple(x):\n    ### BEGIN SOLUTION\n    return x * 3\n    ### END SOLUTION"),
        grade("test_triple", 3, "3.0 if triple(2) == 6 else 0.0"),
        answer("warn", f"def warn():\n    ### BEGIN SOLUTION\n    {WARN}\n    ### END SOLUTION"),
        grade("test_warn", 1, "warn()\n1.0"),
    )
