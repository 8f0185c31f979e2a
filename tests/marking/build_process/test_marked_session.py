"""Sessions in terminals, marked in the sandbox, where no program can be started."""

import nbformat
import pytest

from grader.marking.pool import Pool
from grader.marking.submission.assignment_release import Release
from grader.marking.submission.submitted_files import read_folder
from grader.marking.task import MarkingTask
from tests.exercises.packages.session import students as session
from tests.marking.student_processes import USUAL
from tests.marking.tiny import answer, grade

WRITES = "%%writefile ws/src/watchman/session.txt\n"


@pytest.mark.soak
def test_what_was_typed_is_typed_again_in_the_sandbox(tmp_path):
    cells = [
        nbformat.v4.new_code_cell("from grader.exercises import packages", id="setup"),
        nbformat.v4.new_code_cell('packages.write_watchman("ws")', id="session-package"),
        answer("session", "# yours"),
        grade("session-points", 12, 'packages.session.grade("ws")'),
    ]
    release = Release("11_tiny", {"tiny": nbformat.v4.new_notebook(cells=cells)})
    tasks = []
    for name in ("FourTerminals", "NotSourced"):
        text = getattr(session, name).files["watchman/session.txt"]
        notebook = nbformat.from_dict(release.notebooks["tiny"])
        typed = [
            dict(cell, source=WRITES + text) if cell.id == "session" else cell for cell in notebook.cells
        ]
        (tmp_path / name).mkdir()
        nbformat.write(nbformat.from_dict({**notebook, "cells": typed}), tmp_path / name / "tiny.ipynb")
        tasks.append(MarkingTask(name, release, read_folder(tmp_path / name, release), name))
    with Pool(1, secret="a secret", time_limits=USUAL) as pool:
        points = {result.student: result.points for result in pool.mark(tasks)}
    assert points == {"FourTerminals": 12.0, "NotSourced": 0.0}
