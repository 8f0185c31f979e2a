import re
import shutil
from pathlib import Path

import nbformat
import pytest
from nbgrader.api import Gradebook

from grader.course_files.notebook_format import normalize
from grader.marking.errors import CommandFailed
from grader.marking.release.make_exercises import differences, main, release
from grader.marking.release.nbgrader_command import assignments, nbgrader
from grader.marking.secret import ACCEPTED
from tests.marking.tiny import ROOT, grade

HIDDEN = re.compile(r"^\s*### BEGIN (SOLUTION|HIDDEN TESTS)$(.*?)^\s*### END \1$", re.M | re.S)


def lines(text: str) -> set[str]:
    return {line.strip() for line in text.splitlines() if line.strip()}


def code(notebook: Path) -> str:
    return "\n".join(cell.source for cell in nbformat.read(notebook, 4).cells)


def leaks(solution: Path, released: Path) -> set[str]:
    """Lines that a student can read although they stand only between the marks of a solution."""
    source = code(solution)
    hidden = lines("\n".join(text for _, text in HIDDEN.findall(source)))
    return (hidden - lines(HIDDEN.sub("", source))) & lines(code(released))


def test_a_release_holds_the_questions_without_the_answers(tiny_course):
    release(tiny_course)
    solution, released = (tiny_course / top / "01_tiny" / "tiny.ipynb" for top in ("solutions", "exercises"))
    assert "def double(x):\n    # YOUR CODE HERE\n    raise NotImplementedError()" in code(released)
    assert leaks(solution, released) == set()
    assert leaks(solution, solution) >= {"return x + x", "return x * 3"}


def test_plain_nbgrader_releases_notebooks_in_the_one_form(tiny_course):
    nbgrader(tiny_course, "generate_assignment", "01_tiny")
    assert normalize([tiny_course / "exercises"], check=True) == []


def test_a_release_made_twice_is_the_same_and_says_what_it_is_at(tiny_course, monkeypatch, capfd):
    monkeypatch.chdir(tiny_course)
    assert main([]) == 0
    assert capfd.readouterr().out == "1 of 1: exercises/01_tiny\n"
    assert differences(tiny_course) == []
    assert capfd.readouterr().out == ""


def test_answer_files_stay_and_data_files_go_along(tiny_course):
    solutions = tiny_course / "solutions" / "01_tiny"
    for name in ("double_answer.py", "solution.txt", "answers.json", "my_module.py", ".secret", "map.toml"):
        (solutions / name).write_text("x")
    release(tiny_course)
    files = {path.name for path in (tiny_course / "exercises").rglob("*") if path.is_file()}
    assert files == {"tiny.ipynb", "map.toml"}


def test_every_kind_of_difference_is_named(tiny_course, monkeypatch, capsys):
    (tiny_course / "solutions" / "01_tiny" / "map.toml").write_text("x")
    release(tiny_course)
    exercises = tiny_course / "exercises" / "01_tiny"
    (exercises / "tiny.ipynb").write_text("changed")
    (exercises / "map.toml").unlink()
    (exercises / "notes.txt").write_text("new")
    monkeypatch.chdir(tiny_course)
    assert main(["--check"]) == 1
    assert capsys.readouterr().out == (
        "exercises/01_tiny/map.toml is missing\n"
        "exercises/01_tiny/notes.txt has no source in solutions/\n"
        "exercises/01_tiny/tiny.ipynb is not what solutions/ produces now\n"
        "Run `make exercises` and commit what it changes.\n"
    )


def test_an_assignment_without_a_source_goes(tiny_course):
    stale = tiny_course / "exercises" / "00_old"
    stale.mkdir(parents=True)
    release(tiny_course)
    assert not stale.exists()


def test_a_failed_command_says_which_and_what_it_printed(tiny_course):
    with pytest.raises(CommandFailed) as failed:
        nbgrader(tiny_course, "autograde", "09_unknown", **{ACCEPTED: "yes"})
    first, *last = str(failed.value).splitlines()
    assert first == f"`nbgrader autograde 09_unknown` failed in {tiny_course}:"
    assert "No notebooks were matched" in last[-1]


def test_a_release_that_fails_stops_with_what_nbgrader_said(tiny_course, monkeypatch, capsys):
    (tiny_course / "solutions" / "01_tiny" / "tiny.ipynb").write_text("no notebook")
    monkeypatch.chdir(tiny_course)
    assert main([]) == 1
    command = "nbgrader generate_assignment 01_tiny --force"
    assert capsys.readouterr().err.startswith(f"`{command}` failed in {tiny_course}:\n    ")


ASK = "exercises/01_class is as it was: "
OTHER = "students have submitted it, and solutions/01_class has other"
ANEW = "Undo that change, or give the assignment a new name and hand it out again"


def more_cells(course):
    path = course.source("01_class") / "nodes.ipynb"
    notebook = nbformat.read(path, 4)
    notebook.cells.append(grade("test_more", 1, "nodes.more.grade(More)"))
    nbformat.write(notebook, path)


def more_notebooks(course):
    shutil.copy(course.source("01_class") / "nodes.ipynb", course.source("01_class") / "more.ipynb")


def read_only(course):
    path = course.source("01_class") / "nodes.ipynb"
    path.write_text(path.read_text().replace('"points": 4', '"points": 3'))
    text = (course.root / "nbgrader_config.py").read_text()
    address = "sqlite:///file:{Path('class', 'gradebook.db').absolute()}?mode=ro&uri=true"
    text = text.replace("sqlite:///{Path('class', 'gradebook.db').absolute()}", address)
    (course.root / "nbgrader_config.py").write_text(text)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (more_cells, f"{OTHER} graded cells than the gradebook. {ANEW}"),
        (more_notebooks, f"{OTHER} notebooks than the gradebook. {ANEW}"),
        (read_only, "the gradebook is read-only. Run this as the user who owns it"),
    ],
)
def test_a_release_that_can_t_be_made_leaves_the_one_that_there_is(course, capsys, change, sentence):
    with Gradebook(course.database, course.name) as book:
        book.add_submission("01_class", book.update_or_create_student("anna").id)
    released = course.release("01_class") / "nodes.ipynb"
    before = released.read_bytes()
    change(course)
    assert main([]) == 1
    assert capsys.readouterr().err == f"{ASK}{sentence}\n"
    assert released.read_bytes() == before
    assert not (course.root / ".exercises.part").exists()


def test_the_exercises_of_the_course_are_what_its_solutions_give():
    assert differences(ROOT) == []


@pytest.mark.parametrize("assignment", assignments(ROOT))
def test_no_answer_can_be_read_in_the_exercises(assignment):
    for solution in (ROOT / "solutions" / assignment).glob("*.ipynb"):
        assert leaks(solution, solution), f"{solution} marks no solution"
        assert leaks(solution, ROOT / "exercises" / assignment / solution.name) == set()
