import os
import re
import shutil
import subprocess
import sys

import nbformat
import pytest

from grader.marking.command.mark_class import Settings, mark_class
from grader.marking.gradebook.course import Course
from tests.marking.classroom import ASSIGNMENT, gradebook, submit
from tests.marking.fake_pool import opening
from tests.marking.gradebook.test_book import by_hand
from tests.marking.tiny import ROOT


def left_behind(course):
    """All files of the class with their contents, without the names that each marking gives itself."""
    files = {}
    for path in (course.root / "class").rglob("*"):
        if path.suffix == ".ipynb":
            notebook = nbformat.read(path, 4)
            notebook.metadata.pop("marking", None)
            files[path] = nbformat.writes(notebook)
        elif path.is_file() and path.suffix not in (".db", ".json") and path.name != ".lock":
            files[path] = re.sub(r"\d{4}-\d{2}-\d{2}T[\d:.]+", "", path.read_text())
    return {str(path.relative_to(course.root)): content for path, content in files.items()}


@pytest.mark.soak
def test_a_run_that_is_killed_at_any_moment_comes_to_the_same_end(course):
    mark_class(course, ASSIGNMENT, Settings(), opening(course))
    by_hand(course, "anna")
    submit(course, "anna", "bob", "carl", "dora", "eve", line="Line = 3")
    other = Course(shutil.copytree(course.root, course.root.with_name("other")))
    mark_class(course, ASSIGNMENT, Settings(), opening(course))
    expected = gradebook(course)
    assert expected["anna"]["essay"]["needs_manual_grade"]

    command = [sys.executable, "-m", "tests.marking.command.killed", "1"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, cwd=other.root, env=environment, text=True, stdout=subprocess.PIPE)
    killed, ended = map(int, done.stdout.split())
    assert killed >= 20
    for number in range(1, ended + 1):
        found = Course(other.root.with_name(f"ended{number}"))
        assert gradebook(found) == expected
        assert left_behind(found) == left_behind(course)
