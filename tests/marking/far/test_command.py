"""The real command on a small course: alone, and through a scheduler with two workers."""
import shutil

import pytest

from grader.marking.office.cli import main
from grader.marking.office.course import Course
from grader.marking.office.journal import Journal
from grader.marking.result import Result
from tests.marking.hostile.corpus import ASSIGNMENT, course, submit

NAMES = ["honest_right", "linked_secret", "missing_notebook", "renamed_notebook"]


@pytest.fixture(scope="module")
def template(tmp_path_factory):
    folder = course(tmp_path_factory.mktemp("course"))
    assert sorted(submit(folder, NAMES)) == NAMES
    return folder


@pytest.fixture
def folder(template, tmp_path, monkeypatch):
    """A copy for one test, which runs in it."""
    shutil.copytree(template, tmp_path / "course", symlinks=True)
    monkeypatch.chdir(tmp_path / "course")
    return tmp_path / "course"


def kept(folder):
    """What is kept of each submission, without what differs from one marking to the next."""
    files = sorted(Course(folder).journal(ASSIGNMENT).glob("*.json"))
    texts = {file.stem: file.read_text().split("\n", 1)[1] for file in files if file.stem[0] != "."}
    return {name: Result.from_json(text).grade_json() for name, text in texts.items()}


def test_a_class_is_marked_on_other_machines_as_on_this_one(shared, folder, capsys):
    shared.with_workers(2)
    assert main([ASSIGNMENT, "--dask", shared.address, "--no-feedback"]) == 0
    assert "\n4 marked now, 4 of 4 in all, in " in capsys.readouterr().out
    far = kept(folder)
    assert sorted(far) == NAMES
    assert main([ASSIGNMENT, "--force", "--no-feedback"]) == 0
    assert kept(folder) == far


def test_without_a_scheduler_it_stops_and_goes_on_with_another(shared, folder, capsys):
    shared.with_workers(1)
    assert main([ASSIGNMENT, "--dask", "hill", "--student", "honest_right", "--no-feedback"]) == 1
    why = "no Dask scheduler answers at hill (missing port number in address 'hill')"
    again = f"go on with `python -m grader mark {ASSIGNMENT} --resume`"
    assert capsys.readouterr().err == (
        f"Stopped: {why}: `.venv/bin/dask scheduler` starts one. "
        f"What is marked is kept: repair this, then {again}.\n"
    )
    assert main([ASSIGNMENT, "--resume", "--dask", shared.address]) == 0
    assert list(kept(folder)) == ["honest_right"]
    settings = Journal(Course(folder).journal(ASSIGNMENT)).settings()
    assert (settings["dask"], settings["students"]) == (shared.address, ["honest_right"])
