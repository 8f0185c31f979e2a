"""`python -m grader mark --check`: what a machine lacks."""
import shutil
from collections import namedtuple
from pathlib import Path

import pytest

from grader.marking.command import machine
from grader.marking.command.cli import main
from grader.marking.errors import SandboxMissing
from tests.marking.fake_pool import ReadyPool

NOTHING = "Nothing is missing: a right answer and a wrong one were marked correctly.\n"


@pytest.fixture
def check(course, monkeypatch, capsys):
    """Runs the command on a machine that has all: its exit status, what it prints, and to stderr."""
    monkeypatch.setattr(machine, "_closed", lambda path: None)
    monkeypatch.setattr(machine.shutil, "which", lambda name: f"/usr/bin/{name}")

    def run(open_pool=None) -> tuple[int, str, str]:
        capsys.readouterr()
        status = main(["--check"], open_pool or ReadyPool(course).open)
        return (status, *capsys.readouterr())

    return run


def test_a_machine_that_has_all(check):
    assert check() == (0, NOTHING, "")


def test_without_a_sandbox_it_says_so_and_marks_nothing(check, course):
    def missing(settings, secret):
        raise SandboxMissing("There is no bubblewrap.")

    assert check(missing) == (1, "", "There is no bubblewrap.\n")
    assert not course.journal("01_class").exists()


def test_a_full_disk_and_a_secret_that_others_may_read(check, course, monkeypatch):
    usage = namedtuple("usage", "free")
    monkeypatch.setattr(shutil, "disk_usage", lambda folder: usage(2e6 if "class" in str(folder) else 1e9))
    (course.root / ".secret").touch(mode=0o644)
    place = course.root / "class"
    assert check() == (
        1,
        "",
        f"Others may read {course.root / '.secret'}: run `chmod 600 .secret`, then mark again.\n"
        f"Only 2 MB are free in {place}, and marking needs 500 MB: free some space.\n",
    )


def test_a_folder_that_can_t_be_written(check, course, monkeypatch):
    monkeypatch.setattr(machine.os, "access", lambda path, mode: False)
    reported = f"{course.root / 'class'} can't be written: mark as the user who owns it.\n"
    assert check() == (1, "", reported)


def test_what_only_a_part_needs_is_said_with_the_status_of_a_machine_that_has_all(check, monkeypatch):
    monkeypatch.setattr(machine.shutil, "which", lambda name: None)
    assert check() == (
        0,
        "There is no gcc and no g++, so packages of interfaces can't be built: install them with "
        f"`sudo apt install build-essential`.\n{NOTHING}",
        "",
    )


def test_a_folder_that_others_can_t_enter_is_named(course, tmp_path, monkeypatch):
    venv = tmp_path / "closed" / "venv"
    venv.mkdir(parents=True)
    (tmp_path / "closed").chmod(0o700)
    monkeypatch.setattr(machine.sys, "prefix", str(venv))
    closed = machine._closed(venv)  # pytest's own folder may be closed, too
    assert closed in venv.parents
    sentence = f"{closed} is closed to other users, so only you can mark with its packages, {venv}"
    assert sentence in list(machine.weaknesses(course))
    assert machine._closed(Path("/usr")) is None


def test_without_an_assignment_it_says_what_it_needs(capsys):
    with pytest.raises(SystemExit):
        main([])
    expected = "python -m grader mark: error: the following arguments are required: ASSIGNMENT\n"
    assert capsys.readouterr().err.endswith(expected)
