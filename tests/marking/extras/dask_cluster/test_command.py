"""The real command on a small course, through a scheduler with two workers."""
import shutil

import pytest
from nbgrader.api import Gradebook

from grader.marking.command.cli import main
from grader.marking.gradebook.course import Course
from grader.marking.journal import Journal
from tests.marking.hostile.corpus import ASSIGNMENT, course, submit

POINTS = {"honest_right": 33.0, "linked_secret": 15.0, "missing_notebook": 0.0, "renamed_notebook": 15.0}


@pytest.fixture(scope="module")
def template(tmp_path_factory):
    folder = course(tmp_path_factory.mktemp("course"))
    assert sorted(submit(folder, list(POINTS))) == list(POINTS)
    return folder


@pytest.fixture
def folder(template, tmp_path, monkeypatch):
    """A copy for one test, which runs in it."""
    shutil.copytree(template, tmp_path / "course", symlinks=True)
    monkeypatch.chdir(tmp_path / "course")
    return tmp_path / "course"


def kept(folder):
    """The points of each submission in the gradebook."""
    with Gradebook(f"sqlite:///{folder}/class/gradebook.db", "ros2") as book:
        return {found.student.id: found.score for found in book.assignment_submissions(ASSIGNMENT)}


def test_a_class_is_marked_in_sandboxes_on_other_machines(shared, folder, capsys):
    shared.with_workers(2)
    assert main([ASSIGNMENT, "--dask", shared.address, "--no-feedback"]) == 0
    assert "\n4 marked now, 4 of 4 in all, in " in capsys.readouterr().out
    assert kept(folder) == POINTS


def test_without_a_scheduler_it_stops_and_goes_on_with_another(shared, folder, capsys):
    shared.with_workers(1)
    assert main([ASSIGNMENT, "--dask", "hill", "--student", "honest_right", "--no-feedback"]) == 1
    why = "no Dask scheduler answers at hill (missing port number in address 'hill')"
    again = f"continue with `python -m grader mark {ASSIGNMENT} --resume`"
    assert capsys.readouterr().err == (
        f"Stopped: {why}: `.venv/bin/dask scheduler` starts one. "
        f"What is marked is stored: fix this, then {again}.\n"
    )
    assert main([ASSIGNMENT, "--resume", "--dask", shared.address]) == 0
    assert kept(folder) == {"honest_right": 33.0}
    settings = Journal(Course(folder).journal(ASSIGNMENT)).settings()
    assert (settings["dask"], settings["students"]) == (shared.address, ["honest_right"])
