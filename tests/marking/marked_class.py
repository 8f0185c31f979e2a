"""A class with marks, and fixtures for commands that report them."""
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from nbgrader.api import Gradebook

from grader.__main__ import main
from grader.marking.command.cli import main as mark
from grader.marking.gradebook.course import Course
from grader.marking.result import Result
from grader.marking.task import MarkingTask
from tests.marking.classroom import ASSIGNMENT, result
from tests.marking.fake_pool import ReadyPool
from tests.marking.made_once import made_once

SCRIPT = "<script>alert(1)</script>"


def marked(course: Course, task: MarkingTask, line: float = 6.0) -> Result:
    """All points in the first test cell; in the second those given, and none for bob."""
    (note,) = result(course, task).notebooks
    earned = {"test_counter": 4.0, "test_line": line} if task.student != "bob" else {}
    cells = [replace(cell, points=earned.get(cell.cell, 0.0)) for cell in note.cells]
    return result(course, task, notebooks=[replace(note, cells=cells)])


def mark_by_hand(course: Course, points: float = 5.0) -> None:
    """What the instructor enters in the formgrader: points of all essays, and nothing left to look at."""
    with Gradebook(course.database, course.name) as book:
        for submission in book.assignment_submissions(ASSIGNMENT):
            for grade in submission.notebooks[0].grades:
                grade.needs_manual_grade = False
                if grade.name == "essay":
                    grade.manual_score = points if submission.student.id != "bob" else 0.0
        book.db.commit()


def write_secret(folder: Path, text: str) -> None:
    (folder / ".secret").write_text(text)
    (folder / ".secret").chmod(0o600)


@pytest.fixture(scope="session")
def marked_template(template: Path, tmp_path_factory) -> Path:
    """The class, marked: anna has 15 of 15 points, eve, with an odd name, too, and bob has none."""

    def make(folder: Path) -> None:
        shutil.copytree(template, folder, dirs_exist_ok=True)
        write_secret(folder, "of this class")
        with pytest.MonkeyPatch.context() as patch:
            patch.chdir(folder)
            course = Course(folder)
            assert mark([ASSIGNMENT, "--no-feedback"], ReadyPool(course, marked).open) == 0
            with Gradebook(course.database) as book:
                book.update_or_create_student("anna", first_name="Anna", last_name="Meier")
                book.update_or_create_student("eve", first_name=SCRIPT, last_name="\u202eevE\x1b[2J")

    return made_once(tmp_path_factory, "marked_class", make)


@pytest.fixture
def course(marked_template, tmp_path, monkeypatch) -> Course:
    """A copy of that class, with nothing left to look at, for a test that runs in its folder."""
    folder = tmp_path / "class"
    shutil.copytree(marked_template, folder)
    monkeypatch.chdir(folder)
    course = Course(folder)
    mark_by_hand(course)
    return course


@pytest.fixture
def say(capsys) -> Callable[..., tuple[int, str, str]]:
    """Runs a command: its exit status, what it prints, and what it prints to stderr."""

    def run(*words: str) -> tuple[int, str, str]:
        capsys.readouterr()
        status = main(list(words))
        return (status, *capsys.readouterr())

    return run
