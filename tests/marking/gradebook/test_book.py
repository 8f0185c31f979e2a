import shutil
import sqlite3
from dataclasses import replace
from datetime import datetime

import nbformat
import pytest
import sqlalchemy
from nbgrader.api import Gradebook

from grader.marking.errors import GradebookError
from grader.marking.gradebook.book import Book
from grader.marking.gradebook.course import Course, timestamp
from grader.marking.gradebook.marked_notebooks import marked_notebooks
from grader.marking.journal import JournalEntry
from grader.marking.release.make_exercises import release
from grader.marking.release.nbgrader_command import nbgrader
from grader.marking.result import CellResult
from grader.marking.secret import ACCEPTED
from tests.marking.classroom import ASSIGNMENT, classroom, gradebook, result, submit, tasks

LATE = """
from nbgrader.plugins import LateSubmissionPlugin

class Late(LateSubmissionPlugin):
    def late_submission_penalty(self, student_id, score, total_seconds_late):
        return 1.5
"""


@pytest.fixture
def task(course):
    return tasks(course)[0]


def test_the_points_of_a_class_are_exported_into_its_folder(course, task):
    with Book(course) as book:
        book._gradebook.add_assignment("02_later")
    write(course, task)
    with Gradebook(course.database) as book:
        book.update_or_create_student("bob", first_name="Bob", last_name="Hill")
    nbgrader(course.root, "export")
    rows = (course.root / "class" / "grades.csv").read_text().splitlines()
    reported = [[row.split(",")[index] for index in (0, 3, 4, 9)] for row in rows[1:]]
    score = str(gradebook(course)["anna"]["score"])
    assert reported == [["01_class", "bob", "Hill", "0.0"], ["01_class", "anna", "anna", score]]
    assert not (course.root / "grades.csv").exists()


def test_a_name_that_the_gradebook_has_stays(course, task):
    with Gradebook(course.database) as book:
        book.update_or_create_student("anna", first_name="Anna", last_name="Meier")
    write(course, task)
    with Gradebook(course.database) as book:
        assert book.find_student("anna").last_name == "Meier"


@pytest.fixture
def file(course):
    return course.root / "class" / "gradebook.db"


def write(course, task, **changes):
    entry = JournalEntry("ab12", result(course, task, **changes))
    with Book(course) as book:
        when, _ = timestamp(course.submitted(task.student, ASSIGNMENT))
        book.write(entry.result, marked_notebooks(entry, task.release), when)


def cells(found, *changed):
    """A result whose cells are these."""
    (note,) = found.notebooks
    return {"notebooks": [replace(note, cells=list(changed))]}


def asks(cell):
    """Points, and whether someone has to look."""
    return cell["auto_score"], cell["needs_manual_grade"]


def by_hand(course, student):
    """What an instructor enters into the formgrader."""
    with Gradebook(course.database, course.name) as book:
        (notebook,) = book.find_submission(ASSIGNMENT, student).notebooks
        grades = {grade.name: grade for grade in notebook.grades}
        grades["test_counter"].manual_score, grades["test_counter"].extra_credit = 3.5, 0.25
        grades["essay"].manual_score = 4
        for grade in grades.values():
            grade.needs_manual_grade = False
        book.find_comment("line", "nodes", ASSIGNMENT, student).manual_comment = "See me."
        book.db.commit()


@pytest.mark.soak
def test_it_writes_what_nbgrader_autograde_writes(tmp_path, monkeypatch):
    """The same class, marked by nbgrader where test cells say their points, and by us."""
    course = classroom(tmp_path / "class")
    source = course.source(ASSIGNMENT) / "nodes.ipynb"
    notebook = nbformat.read(source, 4)
    tests = {"set-up": "", "test_counter": "Counter + 0.5", "test_line": "Line * 1.25"}
    for cell in notebook.cells:
        cell.source = tests.get(cell.id, cell.source)
    nbformat.write(notebook, source)
    (course.root / "late.py").write_text(LATE)
    with open(course.root / "nbgrader_config.py", "a") as configuration:
        configuration.write("\nc.AssignLatePenalties.plugin_class = 'late.Late'\n")
    release(course.root)
    with Gradebook(course.database, course.name) as book:
        book.update_or_create_assignment(ASSIGNMENT, duedate=datetime(2026, 1, 5))
    submit(course, "anna", time="2026-01-06 10:00:00 UTC")
    submit(course, "bob", line="# YOUR CODE HERE\nraise NotImplementedError()")
    shutil.copytree(course.root, tmp_path / "other")
    nbgrader(course.root, "autograde", ASSIGNMENT, **{ACCEPTED: "yes"})
    by_hand(course, "anna")
    nbgrader(course.root, "autograde", ASSIGNMENT, "--force", "--student", "anna", **{ACCEPTED: "yes"})

    monkeypatch.chdir(tmp_path / "other")
    own = Course(tmp_path / "other")
    for student, line in (("anna", 2.5), ("bob", 0.0), ("anna", 2.5)):
        task = next(task for task in tasks(own) if task.student == student)
        earned = [CellResult("test_counter", "counter", 1.5, 4.0), CellResult("test_line", "line", line, 6.0)]
        write(own, task, **cells(result(own, task), *earned))
        if student == "bob":
            by_hand(own, "anna")
    expected = gradebook(course)
    assert gradebook(own) == expected
    assert expected["anna"]["penalties"] == [1.5]
    assert expected["anna"]["test_counter"]["needs_manual_grade"]
    assert expected["bob"]["line comment"]["auto_comment"] == "No response."
    assert expected["bob"]["essay"]["auto_score"] is None


def test_written_twice_it_says_the_same(course, task):
    write(course, task)
    once = gradebook(course)
    write(course, task)
    assert gradebook(course) == once
    assert once["anna"]["time"] == "2026-01-01 10:00:00"
    with Book(course) as book:
        assert book.has(ASSIGNMENT, "anna", datetime(2026, 1, 1, 10))
        assert not book.has(ASSIGNMENT, "anna", None)
        assert not book.has(ASSIGNMENT, "anna", datetime(2026, 1, 2))
        assert not book.has(ASSIGNMENT, "zoe", None)


def test_a_refused_submission_has_a_row_with_nothing_and_the_reason_as_comment(course, task):
    write(course, task, verdict="refused", reason="It is empty.", notebooks=[])
    row = gradebook(course)["anna"]
    assert {asks(row[cell]) for cell in ("test_counter", "test_line", "essay")} == {(0, False)}
    assert row["counter comment"]["auto_comment"] == "It is empty."
    write(course, task)
    assert gradebook(course)["anna"]["counter comment"]["auto_comment"] is None


def test_what_an_instructor_has_to_look_at_asks_for_it(course, task):
    broken = CellResult("test_counter", "counter", 0.0, 4.0, needs_look=True)
    more_than_it_is_worth = CellResult("test_line", "line", 8.0, 10.0)
    write(course, task, **cells(result(course, task), broken, more_than_it_is_worth))
    row = gradebook(course)["anna"]
    assert asks(row["test_counter"]) == (0, True)
    assert asks(row["test_line"]) == (6, True)
    write(course, task, **cells(result(course, task), broken))
    assert gradebook(course)["anna"]["test_line"]["needs_manual_grade"]


def test_a_written_answer_that_is_as_given_out_has_no_points(course):
    shutil.copy(course.release(ASSIGNMENT) / "nodes.ipynb", course.submitted("anna", ASSIGNMENT))
    write(course, tasks(course)[0])
    row = gradebook(course)["anna"]
    assert asks(row["essay"]) == (0, False)
    assert row["essay comment"]["auto_comment"] == "No response."


def test_a_task_that_a_person_marks_stays_as_it_is(course, task):
    found = result(course, task)
    settings = found.notebooks[0].notebook["cells"][-1]["metadata"]["nbgrader"]
    settings |= {"task": True, "grade": False, "solution": False, "locked": True}
    write(course, task, notebooks=found.notebooks)
    assert asks(gradebook(course)["anna"]["essay"]) == (None, True)


def test_where_writing_fails_nothing_of_the_submission_is_written(course, task):
    found = result(course, task)
    del found.notebooks[0].notebook["cells"][-1]["metadata"]["nbgrader"]["points"]
    with pytest.raises(KeyError):
        write(course, task, notebooks=found.notebooks)
    assert gradebook(course) == {}
    with Gradebook(course.database, course.name) as book:
        assert book.students == []


def refused(course, task):
    with pytest.raises(GradebookError) as failed:
        write(course, task)
    return str(failed.value)


def test_a_gradebook_that_another_program_holds_is_left_alone(course, task, file):
    course.directory.db_url += "?timeout=0.05"  # seconds of patience
    other = sqlite3.connect(file)
    other.execute("BEGIN EXCLUSIVE")
    advice = "another program has locked it: close the formgrader's page or wait, then mark again"
    expected = f"the gradebook {course.database} can't be used (database is locked): {advice}"
    assert refused(course, task) == expected
    other.rollback()
    write(course, task)
    assert list(gradebook(course)) == ["anna"]


def test_a_gradebook_that_is_read_only_is_reported(course, task, file):
    course.directory.db_url = f"sqlite:///file:{file}?mode=ro&uri=true"
    assert refused(course, task).endswith(
        "can't be used (attempt to write a readonly database): it is read-only: mark as the user who owns it"
    )


def test_a_gradebook_on_a_full_disk_is_reported(course, task):
    with Book(course) as book:
        engine = book._gradebook.engine
        engine.dispose()
        sqlalchemy.event.listen(engine, "connect", lambda new, _: new.execute("PRAGMA max_page_count = 1"))
        refused = result(course, task, verdict="refused", reason="long " * 10_000, notebooks=[])
        entry = JournalEntry("ab12", refused)
        with pytest.raises(GradebookError) as failed:
            book.write(entry.result, marked_notebooks(entry, task.release), None)
    expected = "can't be used (database or disk is full): the disk is full: free some space, then mark again"
    assert str(failed.value).endswith(expected)
    assert gradebook(course) == {}


def test_a_gradebook_of_another_nbgrader_says_what_to_run(course, task, file):
    file.unlink()
    with sqlite3.connect(file) as other:
        other.execute("CREATE TABLE student (name TEXT)")
    assert refused(course, task).endswith(
        "): it is another nbgrader version's: copy it, run `nbgrader db upgrade`, then mark again"
    )


def test_a_file_that_is_no_gradebook_is_reported(course, task, file):
    file.write_text("this is no database, however long one looks at it" * 100)
    expected = "can't be used (file is not a database): repair it, then mark again"
    assert refused(course, task).endswith(expected)
