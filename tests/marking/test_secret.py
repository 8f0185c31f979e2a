import os

import nbformat
import pytest

from grader.marking import secret
from grader.marking.judge.personal_release import TAG
from grader.seeds import private_seed, secret_of_student
from tests.marking.tiny import ROOT


@pytest.fixture
def secret_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("COURSE_SECRET", raising=False)
    monkeypatch.setenv(secret.ACCEPTED, "yes")
    file = tmp_path / ".secret"
    file.touch(mode=0o600)
    return file


def test_the_secret_shows_while_marking_only(secret_file):
    secret_file.write_text("d1ce\n")
    secret.set_course_secret(assignment="01", student="*", notebooks=["/class/submitted/ann/01/tiny.ipynb"])
    assert os.environ["COURSE_SECRET"] == secret_of_student("d1ce", "ann")
    secret.remove_course_secret(assignment="01", student="*", notebooks=[])
    assert "COURSE_SECRET" not in os.environ


def test_seeds_differ_by_student_and_are_the_same_in_each_marking(secret_file):
    secret_file.write_text("d1ce")
    shown = []
    for student in ("ann", "bob", "ann"):
        secret.set_course_secret(notebooks=[f"class/submitted/{student}/01/tiny.ipynb"])
        shown.append(private_seed(os.environ["COURSE_SECRET"], "wall", 0))
    secret.remove_course_secret()
    assert shown == [668764764, 4190639955, 668764764]
    assert secret_of_student("", "ann") == ""


def test_nbgrader_s_own_marking_refuses_an_assignment_with_variants(secret_file):
    secret_file.write_text("d1ce")
    first = nbformat.v4.new_markdown_cell("# Varied", metadata={"tags": [TAG]})
    folder = secret_file.parent / "exercises" / "01"
    folder.mkdir(parents=True)
    nbformat.write(nbformat.v4.new_notebook(cells=[first]), folder / "varied.ipynb")
    with pytest.raises(SystemExit) as refused:
        secret.set_course_secret(notebooks=["class/submitted/ann/01/varied.ipynb"])
    assert str(refused.value) == (
        "Not marked: 01 has variants, and `nbgrader autograde` would run the same tests for every student. "
        "Use `python -m grader mark 01`."
    )
    assert "COURSE_SECRET" not in os.environ


def test_without_the_file_marking_uses_the_public_seeds(secret_file):
    secret_file.unlink()
    secret.set_course_secret()
    assert "COURSE_SECRET" not in os.environ


@pytest.mark.parametrize("value", ["", "no", "1"])
def test_without_the_instructors_word_nbgrader_does_not_run_students_code(secret_file, monkeypatch, value):
    monkeypatch.setenv("RUN_WITHOUT_SANDBOX", value)
    with pytest.raises(SystemExit) as stopped:
        secret.set_course_secret()
    assert str(stopped.value) == (
        "Not marked: `nbgrader autograde` runs students' code without a sandbox, where it can read and "
        "change all your files. Use `python -m grader mark`, or set the environment variable "
        "RUN_WITHOUT_SANDBOX=yes."
    )


def test_a_secret_that_others_may_read_stops_the_marking(secret_file):
    secret_file.write_text("d1ce")
    secret_file.chmod(0o644)
    with pytest.raises(SystemExit) as stopped:
        secret.set_course_secret()
    assert str(stopped.value) == f"Others may read {secret_file}: run `chmod 600 .secret`, then mark again."


def test_an_empty_secret_stops_the_marking(secret_file):
    with pytest.raises(SystemExit) as stopped:
        secret.set_course_secret()
    assert str(stopped.value) == f"{secret_file} is empty: write a long random line into it, or delete it."


def test_a_secret_that_cannot_be_read_stops_the_marking(secret_file):
    secret_file.unlink()
    secret_file.mkdir(mode=0o700)
    with pytest.raises(SystemExit) as stopped:
        secret.set_course_secret()
    expected = f"{secret_file} cannot be read (Is a directory): mark as the user who owns it."
    assert str(stopped.value) == expected


def test_the_secret_is_never_under_version_control():
    assert "/.secret\n" in (ROOT / ".gitignore").read_text()
