import shutil
from pathlib import Path

import pytest

from grader.marking.office.course import Course
from tests.marking.classroom import classroom, submit

TIME = "2026-01-01 10:00:00 UTC"


@pytest.fixture(scope="session")
def template(tmp_path_factory) -> Path:
    """A class in which anna, bob and eve have handed in; made once, for nbgrader takes its time."""
    course = classroom(tmp_path_factory.mktemp("class"))
    submit(course, "anna", "bob", "eve", time=TIME)
    return course.root


@pytest.fixture
def course(template: Path, tmp_path: Path, monkeypatch) -> Course:
    """A copy of that class for one test, which runs in its folder."""
    folder = tmp_path / "class"
    shutil.copytree(template, folder)
    monkeypatch.chdir(folder)
    return Course(folder)
