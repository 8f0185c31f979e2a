import os
import shutil
from pathlib import Path

import pytest

from grader.marking.gradebook.course import Course
from grader.marking.task import MarkingTask
from tests.marking.assignment import hand_in, release
from tests.marking.classroom import classroom, submit
from tests.marking.made_once import made_once
from tests.marking.student_processes import plain_sandbox, start_student, student  # noqa: F401
from tests.marking.tiny import tiny

TIME = "2026-01-01 10:00:00 UTC"


@pytest.fixture
def tiny_course(tmp_path: Path) -> Path:
    """A small course of its own for one test, not released yet."""
    return tiny(tmp_path)


@pytest.fixture
def gate(tmp_path) -> Path:
    """A pipe at which a cell says that it is there, and waits for someone who reads that."""
    os.mkfifo(tmp_path / "gate")
    return tmp_path / "gate"


@pytest.fixture
def waiting(tmp_path, gate) -> MarkingTask:
    """A submission whose cell waits at the gate."""
    cell = f"open({str(gate)!r}, 'w').write('x')"
    return hand_in(tmp_path / "ann", release(tmp_path / "02_two"), {"greeting-see": cell})


@pytest.fixture
def staying(tmp_path, gate) -> MarkingTask:
    """A submission whose cell says at the gate that it is there, and stays."""
    cell = f"open({str(gate)!r}, 'w').write('x')\nopen({str(gate)!r}).read()  # no one writes"
    return hand_in(tmp_path / "ann", release(tmp_path / "02_two"), {"greeting-see": cell})


@pytest.fixture(scope="session")
def template(tmp_path_factory) -> Path:
    """A class in which anna, bob and eve have handed in; made once, for nbgrader takes its time."""

    def make(folder: Path) -> None:
        submit(classroom(folder), "anna", "bob", "eve", time=TIME)

    return made_once(tmp_path_factory, "class", make)


@pytest.fixture
def course(template: Path, tmp_path: Path, monkeypatch) -> Course:
    """A copy of that class for one test, which runs in its folder."""
    folder = tmp_path / "class"
    shutil.copytree(template, folder)
    monkeypatch.chdir(folder)
    return Course(folder)
