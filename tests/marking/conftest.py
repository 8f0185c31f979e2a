"""A tiny course, with exercises that need no robot."""
from pathlib import Path

import nbformat
import pytest

ROOT = Path(__file__).parents[2]


def answer(grade_id: str, source: str) -> nbformat.NotebookNode:
    return _cell(grade_id, source, solution=True, locked=False, grade=False)


def grade(grade_id: str, points: float, source: str) -> nbformat.NotebookNode:
    return _cell(grade_id, source, solution=False, locked=True, grade=True, points=points)


def _cell(grade_id: str, source: str, **nbgrader: object) -> nbformat.NotebookNode:
    metadata = {"grade_id": grade_id, "schema_version": 3, "task": False, "cell_type": "code", **nbgrader}
    return nbformat.v4.new_code_cell(source, id=grade_id, metadata={"nbgrader": metadata})


def write(path: Path, *cells: nbformat.NotebookNode) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    nbformat.write(nbformat.v4.new_notebook(cells=list(cells)), path)


@pytest.fixture
def tiny(tmp_path: Path) -> Path:
    """A course with one assignment: two exercises, of 2 and 3 points."""
    (tmp_path / "nbgrader_config.py").write_text((ROOT / "nbgrader_config.py").read_text())
    write(
        tmp_path / "solutions" / "01_tiny" / "tiny.ipynb",
        answer("double", "def double(x):\n    ### BEGIN SOLUTION\n    return x + x\n    ### END SOLUTION"),
        grade("test_double", 2, "assert double(3) == 6"),
        answer("triple", "def triple(x):\n    ### BEGIN SOLUTION\n    return x * 3\n    ### END SOLUTION"),
        grade("test_triple", 3, "3.0 if triple(2) == 6 else 0.0"),
    )
    return tmp_path
