import errno
import json
import os
import resource
import subprocess
import sys
from dataclasses import replace

import pytest
from nbconvert.writers import FilesWriter

from grader.__main__ import main as command_line
from grader.marking.command import cli, student_pages, summary_text
from grader.marking.command.cli import main
from grader.marking.command.mark_class import Settings
from grader.marking.errors import SandboxMissing
from grader.marking.gradebook import feedback
from grader.plugins import COMMANDS, plugin_names
from tests.marking.classroom import ASSIGNMENT, gradebook, result
from tests.marking.fake_pool import ReadyPool
from tests.marking.tiny import ROOT

AGAIN = f"continue with `python -m grader mark {ASSIGNMENT} --resume`"


@pytest.fixture
def pool(course):
    return ReadyPool(course)


@pytest.fixture
def command(pool):
    return lambda *options: main([ASSIGNMENT, *options], pool.open)


def test_a_class_is_marked_and_summed_up(course, command, capsys):
    assert command("--csv", "points/all.csv", "--html", "all.html") == 0
    output = capsys.readouterr()
    assert output.out.startswith("student  counter  line  essay  total  verdict  flags\n")
    assert "\n3 marked now, 3 of 3 in all, in " in output.out
    assert output.err.count(" of 3  ") == 3
    assert (course.root / "points" / "all.csv").read_text().startswith("student,assignment,")
    assert (course.root / "all.html").read_text().startswith("<!DOCTYPE html>")
    assert command("--no-feedback") == 0
    output = capsys.readouterr()
    assert "\n0 marked now, 3 of 3 in all, in " in output.out
    assert output.err == ""


def test_options_reach_the_run(command, pool):
    assert command("--student", "eve", "--student", "anna", "--jobs", "3", "--unsafe", "--no-feedback") == 0
    (settings,) = pool.settings
    assert settings == Settings(["anna", "eve"], jobs=3, unsafe=True, feedback=False)
    assert command("--force", "--student", "anna") == 0
    assert (pool.settings[1].force, pool.settings[1].jobs) == (True, len(os.sched_getaffinity(0)))


def test_resume_goes_on_with_the_options_of_the_last_run(course, command, pool, capsys):
    def interrupt(here, task):
        if task.student == "eve":
            raise KeyboardInterrupt
        return result(here, task)

    pool.change = interrupt
    assert command("--student", "anna", "--student", "eve", "--force", "--jobs", "3", "--csv", "a.csv") == 130
    assert capsys.readouterr().err.endswith(f"Stopped. 1 of 2 submissions are marked and stored: {AGAIN}.\n")
    pool.change = result
    pool.again()
    assert command("--resume") == 0
    assert pool.again() == ["eve"]
    assert pool.settings[-1] == replace(pool.settings[0], force=False)
    assert (course.root / "a.csv").read_text().count("\n") == 5
    assert list(gradebook(course)) == ["anna", "eve"]
    assert command("--resume", "--jobs", "1") == 0
    assert json.loads((course.journal(ASSIGNMENT) / ".settings.json").read_text())["jobs"] == 1


def refused(command, capsys, *options):
    assert command(*options) == 1
    output = capsys.readouterr()
    assert output.out == ""
    return output.err


def test_resume_without_a_run_and_with_options_is_refused(command, capsys):
    nothing = f"Not marked: there is no run of {ASSIGNMENT} to continue: leave out --resume.\n"
    assert refused(command, capsys, "--resume") == nothing
    none = "give no others except --jobs and --dask"
    beside = f"Not marked: --resume takes the options of the last run: {none}.\n"
    assert refused(command, capsys, "--resume", "--force") == beside


def test_what_cannot_be_marked_is_reported_in_one_line(command, capsys):
    output = refused(command, capsys, "--student", "ana")
    assert output.startswith(f"Not marked: ana has not handed in {ASSIGNMENT}, ")
    assert output.endswith(": did you mean anna?\n")


def test_several_machines_where_these_are_not_installed(course, monkeypatch, capsys):
    monkeypatch.setattr(cli, "plugin", lambda group, name: None)
    assert main([ASSIGNMENT, "--dask", "tcp://127.0.0.1:1"]) == 1
    expected = "Not marked: several machines are an extra that is not installed here: leave out --dask.\n"
    assert capsys.readouterr().err == expected


def test_without_a_sandbox_it_says_what_to_install(course, capsys):
    words = "There is no bubblewrap here: run `sudo apt install bubblewrap`, or add `--unsafe`."

    def missing(settings, secret):
        raise SandboxMissing(words)

    assert main([ASSIGNMENT], missing) == 1
    assert capsys.readouterr().err == f"Not marked: {words}\n"


def test_a_problem_is_reported_and_gives_an_exit_status(command, pool, course, capsys):
    pool.mark = lambda tasks: (result(course, next(tasks)) for _ in range(2))
    assert command() == 1
    assert capsys.readouterr().err.endswith(
        f"eve was not marked: mark again\nStopped. 2 of 3 submissions are marked and stored: {AGAIN}.\n"
    )


def test_a_file_that_cannot_be_written_stops_it_and_what_is_marked_is_kept(course, command, pool, capsys):
    (course.root / "points.csv").mkdir()
    assert command("--csv", "points.csv") == 1
    kept = f"What is marked is stored: fix this, then {AGAIN}.\n"
    assert capsys.readouterr().err.endswith(
        f"Stopped: points.csv could not be written (Is a directory). {kept}"
    )
    pool.again()
    assert command() == 0
    assert pool.again() == []


@pytest.mark.parametrize("jobs", ["0", "-1", "many", "513"])
def test_a_wrong_number_of_jobs_is_refused(command, capsys, jobs):
    with pytest.raises(SystemExit):
        command(f"--jobs={jobs}")
    expected = f"error: argument --jobs: expected a number from 1 to 512, saw '{jobs}'\n"
    assert capsys.readouterr().err.endswith(expected)


def test_the_command_says_how_it_is_used(tmp_path, monkeypatch, capsys):
    names = plugin_names(COMMANDS)
    assert {"due", "mark"} <= {*names}
    usage = f"usage: python -m grader COMMAND ...\nCommands, each with --help: {', '.join(names)}\n"
    assert (command_line(["--help"]), capsys.readouterr()) == (0, (usage, ""))
    command = [sys.executable, "-m", "grader", "grade"]
    wrong = subprocess.run(command, cwd=ROOT, text=True, capture_output=True)
    assert (wrong.returncode, wrong.stdout, wrong.stderr) == (2, "", usage)
    monkeypatch.chdir(tmp_path)
    assert command_line(["mark", "01_nodes"]) == 1
    expected = f"expected nbgrader_config.py in {tmp_path}, saw none: go to the course's folder"
    assert capsys.readouterr().err == f"Not marked: {expected}.\n"


def test_a_full_disk_loses_nothing_that_is_marked(course, command, pool, capsys):
    """The limit of a file's size stands for the disk: it makes writing fail in the same way."""

    def fill(here, task):
        if task.student == "bob":
            resource.setrlimit(resource.RLIMIT_FSIZE, (0, before[1]))
        return result(here, task)

    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    pool.change = fill
    try:
        status = command("--no-feedback")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert status == 1
    file = course.journal(ASSIGNMENT) / "bob.json"
    assert capsys.readouterr().err.endswith(
        f"Stopped: {file} could not be written (File too large). "
        f"What is marked is stored: fix this, then {AGAIN}.\n"
    )
    assert list(gradebook(course)) == ["anna"]
    pool.change = result
    pool.again()
    assert command("--no-feedback") == 0
    assert pool.again() == ["bob", "eve"]


def test_a_full_disk_while_pages_are_made_is_one_sentence(course, command, monkeypatch, capsys):
    def full(self, *_, **__):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(FilesWriter, "write", full)
    assert command() == 1
    page = "class/feedback/anna/01_class"
    *_, last, stopped = capsys.readouterr().err.splitlines()
    assert last.startswith("3 of 3  eve: ")
    assert stopped == (
        f"Stopped: {course.root / page} could not be written (No space left on device). "
        f"What is marked is stored: free some space, then {AGAIN}."
    )
    assert len(gradebook(course)) == 3


def test_another_error_of_a_page_is_still_that_pages(course, command, monkeypatch, capsys):
    def forbidden(self, *_, **__):
        raise PermissionError(errno.EACCES, "Permission denied")

    monkeypatch.setattr(FilesWriter, "write", forbidden)
    assert command() == 1
    assert capsys.readouterr().err.count("could not be made: `nbgrader generate_feedback") == 3


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_the_progress_of_many_pages_is_shown(course, command, monkeypatch, capsys, jobs):
    for module in (feedback, student_pages):
        monkeypatch.setattr(module, "SHARE", 2)
    assert command("--jobs", jobs) == 0
    assert capsys.readouterr().err.endswith("2 of 3  students' pages\n3 of 3  students' pages\n")


def test_a_large_class_has_a_summary_and_a_file_in_place_of_the_table(course, command, monkeypatch, capsys):
    for module in (summary_text, cli):
        monkeypatch.setattr(module, "MANY", 2)
    assert command("--no-feedback") == 0
    output = capsys.readouterr().out
    assert output.startswith("3 students, of 15 points:\n")
    assert "\nThe points and flags of each student are in class/marking/01_class.csv.\n" in output
    assert (course.root / "class/marking/01_class.csv").read_text().count("\nanna,") == 2
    assert command("--no-feedback", "--csv", "mine.csv") == 0
    assert "class/marking" not in capsys.readouterr().out


def test_a_folder_whose_name_can_t_be_used_is_left_out_and_named(course, command, capsys):
    course.submitted("ann\nbob", ASSIGNMENT).mkdir(parents=True)
    assert command("--no-feedback") == 0
    output = capsys.readouterr().out
    assert "3 marked now, 3 of 3 in all" in output
    reported = "'ann\\nbob': the folder's name has more than one line, so it is left out: rename it"
    assert reported in " ".join(output.split())
