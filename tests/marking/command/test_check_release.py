import shutil

import nbformat
import pytest

from grader.marking.command.check_release import check_release
from grader.marking.errors import CourseError
from grader.marking.gradebook.book import Book
from grader.marking.gradebook.find_submissions import find_submissions
from grader.marking.judge.personal_release import NO_SECRET, TAG
from grader.marking.release.make_exercises import release
from tests.marking.classroom import ASSIGNMENT, POINTS, WRITTEN, tasks

REMAKE = "run `make exercises`, which makes exercises/ from solutions/ and enters it into the gradebook"
KNOWN = {("nodes", cell): points for cell, points in {**POINTS, WRITTEN: 5.0}.items()}


def problem(call, *arguments):
    with pytest.raises(CourseError) as failed:
        call(*arguments)
    return str(failed.value)


def edit(path, **sources):
    """Change the sources of cells, by id."""
    notebook = nbformat.read(path, 4)
    for cell in notebook.cells:
        cell.source = sources.get(cell.id, cell.source)
    nbformat.write(notebook, path)


def test_every_submission_is_a_task_with_a_key_of_its_own(course):
    found = find_submissions(course, ASSIGNMENT)
    assert list(found) == [task.student for task in tasks(course)] == ["anna", "bob", "eve"]
    assert found["anna"] == course.submitted("anna", ASSIGNMENT)
    assert {task.assignment for task in tasks(course)} == {ASSIGNMENT}
    assert len({task.key for task in tasks(course)}) == 3


def test_only_the_chosen_students_are_taken(course):
    assert list(find_submissions(course, ASSIGNMENT, ["eve", "anna"])) == ["anna", "eve"]


def test_the_key_changes_with_submission_release_and_secret_and_with_nothing_else(course):
    def keys(secret=""):
        return [task.key for task in tasks(course, secret)]

    before = keys()
    assert keys() == before
    assert not set(keys("secret")) & set(before)
    edit(course.submitted("bob", ASSIGNMENT) / "nodes.ipynb", line="Line = 3")
    assert [new == old for new, old in zip(keys(), before, strict=True)] == [True, False, True]
    edit(course.release(ASSIGNMENT) / "nodes.ipynb", test_line="nodes.line.grade(Other)")
    assert not set(keys()) & set(before)


def test_an_assignment_that_is_not_there_is_named_with_the_nearest(course):
    folder = course.root / "exercises"
    near = f"{folder} has no assignment 01_clas: did you mean {ASSIGNMENT}?"
    assert problem(find_submissions, course, "01_clas") == near
    assert problem(find_submissions, course, "x") == f"{folder} has no assignment x: there are {ASSIGNMENT}"
    shutil.rmtree(folder)
    assert problem(find_submissions, course, "x") == f"{folder} has no assignment x: {REMAKE}"


def test_where_there_are_no_submissions_it_says_where_notebooks_go(course):
    shutil.rmtree(course.root / "class" / "submitted")
    place = course.root / "class" / "submitted" / "STUDENT" / ASSIGNMENT
    message = f"there are no submissions of {ASSIGNMENT}: put the notebooks into {place}"
    assert problem(find_submissions, course, ASSIGNMENT) == message


def test_a_student_who_has_not_handed_in_is_named_with_the_nearest(course):
    def missing(student):
        folder = course.root / "class" / "submitted" / student / ASSIGNMENT
        return f"{student} has not handed in {ASSIGNMENT}, {folder} is missing: "

    assert problem(find_submissions, course, ASSIGNMENT, ["ana"]) == missing("ana") + "did you mean anna?"
    course.submitted("x", "02_other").mkdir(parents=True)
    three = missing("x") + "3 students have handed it in"
    assert problem(find_submissions, course, ASSIGNMENT, ["x"]) == three
    absent = f"there is no student absent: {course.root / 'class' / 'submitted' / 'absent'} is missing"
    assert problem(find_submissions, course, ASSIGNMENT, ["absent"]) == absent


def test_a_release_that_agrees_with_source_and_gradebook_is_fine(course):
    with Book(course) as book:
        known = book.cells(ASSIGNMENT)
        assert book.cells("02_other") is None
    assert known == KNOWN
    check_release(course, ASSIGNMENT, known)


def test_an_assignment_that_the_gradebook_does_not_know_says_what_to_run(course):
    message = f"the gradebook doesn't know {ASSIGNMENT}: {REMAKE}"
    assert problem(check_release, course, ASSIGNMENT, None) == message


def test_a_release_that_is_not_what_its_source_gives_is_named(course):
    edit(course.source(ASSIGNMENT) / "nodes.ipynb", test_line="nodes.line.grade(Line, Counter)")
    file = f"exercises/{ASSIGNMENT}/nodes.ipynb is not what solutions/ produces now"
    assert (
        problem(check_release, course, ASSIGNMENT, KNOWN)
        == f"{file}: {REMAKE}, or undo the changes to solutions/"
    )
    release(course.root)
    check_release(course, ASSIGNMENT, KNOWN)


def test_variants_need_a_secret_and_a_release_that_has_them(course):
    path = course.release(ASSIGNMENT) / "nodes.ipynb"
    notebook = nbformat.read(path, 4)
    notebook.cells[0].metadata["tags"] = [TAG]
    nbformat.write(notebook, path)
    assert problem(check_release, course, ASSIGNMENT, KNOWN) == NO_SECRET.format(ASSIGNMENT)
    file = course.root / ".secret"
    file.touch(mode=0o600)
    file.write_text("d1ce")
    saw = f"exercises/{ASSIGNMENT}/nodes.ipynb is not what solutions/ produces now"
    message = f"{saw}: {REMAKE}, or undo the changes to solutions/"
    assert problem(check_release, course, ASSIGNMENT, KNOWN) == message


def test_another_answer_in_the_source_is_no_other_release(course):
    answer = "### BEGIN SOLUTION\nLine = 5\n### END SOLUTION"
    edit(course.source(ASSIGNMENT) / "nodes.ipynb", line=answer)
    check_release(course, ASSIGNMENT, KNOWN)


def test_a_gradebook_with_other_cells_or_points_says_which(course):
    less = {key: points for key, points in KNOWN.items() if key[1] != "test_line"}
    message = "the test cell test_line of nodes.ipynb is only in exercises/"
    assert problem(check_release, course, ASSIGNMENT, less) == f"{message}: {REMAKE}"
    more = {**KNOWN, ("nodes", "z"): 1.0}
    message = "the test cell z of nodes.ipynb is only in the gradebook"
    assert problem(check_release, course, ASSIGNMENT, more) == f"{message}: {REMAKE}"
    other = {**KNOWN, ("nodes", "test_line"): 7.0}
    message = "the test cell test_line of nodes.ipynb gives 6 points, and 7 in the gradebook"
    assert problem(check_release, course, ASSIGNMENT, other) == f"{message}: {REMAKE}"


def test_a_test_cell_that_grades_no_exercise_is_refused_before_anything_is_marked(course):
    for folder in (course.source(ASSIGNMENT), course.release(ASSIGNMENT)):
        edit(folder / "nodes.ipynb", test_line="unknown.line.grade(Line)")
    assert problem(check_release, course, ASSIGNMENT, KNOWN).startswith(
        "The test cell `test_line` can't be marked here: expected "
    )
