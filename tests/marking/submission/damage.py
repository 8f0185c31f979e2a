"""Submissions of the real assignments, and ways to damage them."""

import copy
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import nbformat
import pytest
from nbformat import NotebookNode

from grader.marking.errors import Unusable
from grader.marking.release.samples import submission
from grader.marking.submission.assignment_release import Release, load_release
from grader.marking.submission.plain_cells import read_notebook
from grader.marking.submission.rebuild import RebuiltNotebook, RebuiltSubmission, rebuild, rebuild_submission
from grader.marking.submission.submitted_files import read_folder

ROOT = Path(__file__).parents[3]
ASSIGNMENTS = sorted(path.name for path in (ROOT / "exercises").iterdir())
NODES = load_release(ROOT / "exercises" / "01_nodes")
STARTER = NODES.notebooks["nodes"]
SOLUTION = nbformat.read(ROOT / "solutions" / "01_nodes" / "nodes.ipynb", 4)
SOLVED = submission(SOLUTION, STARTER, 1.0)

Damage = Callable[[dict[str, Any]], object]


def data(notebook: NotebookNode | dict[str, Any]) -> bytes:
    """A notebook as a file, in which all that is not ASCII is escaped."""
    return json.dumps(notebook, indent=1, sort_keys=True).encode()


def solved() -> dict[str, Any]:
    """A solved assignment 1 as plain data, to be damaged."""
    return json.loads(data(SOLVED))


def cell(notebook: dict[str, Any], name: str) -> dict[str, Any]:
    return next(cell for cell in notebook["cells"] if cell.get("id") == name)


def position(notebook: dict[str, Any], name: str) -> int:
    return [cell.get("id") for cell in notebook["cells"]].index(name)


def own(source: str, **other: Any) -> dict[str, Any]:
    """A code cell of the student's own."""
    fields = {"id": "f00d", "cell_type": "code", "metadata": {}, "outputs": [], "execution_count": None}
    return {**fields, "source": source, **other}


def rebuilt(damage: Damage, notebook: dict[str, Any] | None = None) -> RebuiltNotebook:
    """What becomes of a solved assignment 1 after `damage`; it must not change when it is rebuilt again."""
    notebook = solved() if notebook is None else notebook
    damage(notebook)
    once = rebuild(STARTER, read_notebook(data(notebook), "nodes.ipynb"))
    twice = rebuild(STARTER, read_notebook(nbformat.writes(once.notebook).encode(), "nodes.ipynb"))
    assert nbformat.writes(twice.notebook) == nbformat.writes(once.notebook)
    assert twice.repairs == twice.flags == []
    nbformat.validate(once.notebook)
    return once


def rebuilt_folder(folder: Path, release: Release = NODES) -> RebuiltSubmission:
    """The result of rebuilding a submission."""
    return rebuild_submission(read_folder(folder, release), release)


def verdict(folder: Path, release: Release = NODES) -> str:
    """The words with which a submission is refused."""
    with pytest.raises(Unusable) as caught:
        rebuilt_folder(folder, release)
    return str(caught.value)


def submit(folder: Path, **files: bytes) -> Path:
    """Write the files, `nodes` for nodes.ipynb, into a new submission in `folder`."""
    target = folder / "class" / "submitted" / "alice" / "01_nodes"
    target.mkdir(parents=True)
    for name, content in files.items():
        (target / f"{name}.ipynb").write_bytes(content)
    return target


def same(notebook: NotebookNode, other: NotebookNode = SOLVED) -> bool:
    """Whether two notebooks are the same to the last byte."""
    return nbformat.writes(notebook) == nbformat.writes(copy.deepcopy(other))
