"""A submission with packages beside its notebook, marked in the sandbox."""

import nbformat
import pytest

from grader.marking.pool import Pool
from grader.marking.result import Result
from grader.marking.submission.assignment_release import Release
from grader.marking.submission.submitted_files import read_folder
from grader.marking.task import MarkingTask
from tests.exercises.packages.greeter import students as greeter
from tests.marking.student_processes import USUAL
from tests.marking.tiny import answer, grade

SETUP = "greeter/setup.py"
WRITES = "%%writefile ws/src/greeter/greeter/hello.py\n"


@pytest.fixture(scope="module")
def release() -> Release:
    cells = [
        nbformat.v4.new_code_cell("from grader.exercises import packages", id="setup"),
        answer("greeter", "# yours"),
        grade("greeter-points", 16, 'packages.greeter.grade("ws")'),
    ]
    return Release("11_tiny", {"tiny": nbformat.v4.new_notebook(cells=cells)})


@pytest.fixture(scope="module")
def results(tmp_path_factory, release) -> dict[str, Result]:
    """What each of a class gets."""
    slow = greeter.NODE.replace("0.5, self", "1.0, self")
    reaches = "import os, pathlib\npathlib.Path(os.path.expanduser('~'), 'left').touch()\n"
    made = {
        "right": (greeter.RIGHT, "# mine"),
        "cell": (greeter.RIGHT, f"{WRITES}{slow}"),
        "link": (greeter.RIGHT, "# mine"),
        "none": ({}, "# mine"),
        "reaches": ({**greeter.RIGHT, SETUP: reaches + greeter.RIGHT[SETUP]}, "# mine"),
        "builds": (greeter.RIGHT, "from grader.workspace.building import build\nbuild({})"),
    }
    tasks = []
    for name, (files, text) in made.items():
        folder = tmp_path_factory.mktemp("class") / name
        for path, content in files.items():
            (folder / "ws/src" / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / "ws/src" / path).write_text(content)
        notebook = nbformat.from_dict(release.notebooks["tiny"])
        cells = [dict(cell, source=text) if cell.id == "greeter" else cell for cell in notebook.cells]
        folder.mkdir(exist_ok=True)
        nbformat.write(nbformat.from_dict({**notebook, "cells": cells}), folder / "tiny.ipynb")
        if name == "link":
            (folder / "ws/src/greeter/more").symlink_to("/etc/passwd")
        tasks.append(MarkingTask(name, release, read_folder(folder, release), name))
    with Pool(2, secret="a secret", time_limits=USUAL) as pool:
        return {result.student: result for result in pool.mark(tasks)}


def text(result: Result) -> str:
    return str([cell["outputs"] for cell in result.notebooks[0].notebook["cells"]])


def test_packages_beside_the_notebook_are_built_and_run(results):
    assert (results["right"].points, results["right"].repairs, results["right"].flags) == (16.0, [], [])


def test_what_a_cell_writes_goes_before_what_was_handed_in(results):
    assert results["cell"].points == 13.0
    assert "1 Hz (6 messages in 6 s)" in text(results["cell"])


def test_a_link_costs_the_files_and_is_reported(results):
    assert (results["link"].points, results["link"].verdict) == (0.0, "repaired")
    assert results["link"].repairs == [
        "No file of your workspace was used. `ws/src/greeter/more` is a link. "
        "Only files are used: put the file itself there."
    ]


def test_without_a_package_it_is_reported(results):
    assert results["none"].points == 0.0
    assert "There is no ws/src/greeter" in text(results["none"])


def test_what_a_setup_writes_is_gone_with_its_sandbox(results):
    assert results["reaches"].points == 16.0


def test_nothing_can_be_built_in_the_students_own_process(results):
    assert results["builds"].points == 16.0
    assert "CannotBuildHere" in text(results["builds"])
