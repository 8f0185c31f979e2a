import shutil
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

ROOT = Path(__file__).parents[2]
WIDGET = "application/vnd.jupyter.widget-view+json"
LESSONS = sorted(ROOT.glob("course/*/*.ipynb"))


@pytest.mark.parametrize("lesson", LESSONS, ids=lambda path: path.parent.name)
def test_a_lesson_runs_from_top_to_bottom(lesson, tmp_path):
    beside = shutil.copytree(lesson.parent, tmp_path / lesson.parent.name)  # lessons write files
    notebook = nbformat.read(lesson, as_version=4)
    NotebookClient(notebook, timeout=60, resources={"metadata": {"path": str(beside)}}).execute()
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", ())]
    assert outputs, "a lesson shows something"
    assert not any(WIDGET in output.get("data", {}) for output in outputs), "a picture that nobody ends"


def test_every_assignment_has_a_lesson():
    assignments = {path.parent.name for path in ROOT.glob("solutions/*/*.ipynb")}
    assert {path.parent.name for path in LESSONS} == {"00_robot", *assignments}
