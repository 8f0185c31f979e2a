import os
import shutil
from datetime import datetime

import pytest

from grader.marking.errors import CourseError
from grader.marking.gradebook.course import Course, time_problem, timestamp
from grader.marking.gradebook.find_submissions import find_submissions
from tests.marking.classroom import ASSIGNMENT, submit


def test_folders_lie_where_the_configuration_says(course):
    assert course.source(ASSIGNMENT) == course.root / "solutions" / ASSIGNMENT
    assert course.release(ASSIGNMENT) == course.root / "exercises" / ASSIGNMENT
    assert course.submitted("anna", ASSIGNMENT) == course.root / "class" / "submitted" / "anna" / ASSIGNMENT
    assert course.autograded("anna", ASSIGNMENT) == course.root / "class" / "autograded" / "anna" / ASSIGNMENT
    assert course.feedback("anna", ASSIGNMENT) == course.root / "class" / "feedback" / "anna" / ASSIGNMENT
    assert course.journal(ASSIGNMENT) == course.root / "class" / "marking" / ASSIGNMENT
    assert course.database == f"sqlite:///{course.root}/class/gradebook.db"
    assert course.name == "ros2"


def test_assignments_are_those_that_are_released(course):
    (course.root / "exercises" / "09_empty").mkdir()
    assert course.assignments() == [ASSIGNMENT]


def test_students_are_those_with_a_folder_for_the_assignment_whatever_their_names(course):
    submit(course, "x [1]", "1a_2")
    course.submitted("zoe", "another").mkdir(parents=True)
    assert list(course.students(ASSIGNMENT)) == ["1a_2", "anna", "bob", "eve", "x [1]"]
    assert course.students(ASSIGNMENT)["x [1]"] == course.submitted("x [1]", ASSIGNMENT)


def test_a_student_whom_the_configuration_leaves_out_is_left_out(course):
    course.directory.student_id_exclude = "bob,carl"
    assert list(course.students(ASSIGNMENT)) == ["anna", "eve"]


def test_another_folder_structure_is_understood(course):
    course.directory.directory_structure = "{nbgrader_step}/{assignment_id}/{student_id}"
    folder = course.submitted("anna", ASSIGNMENT)
    folder.mkdir(parents=True)
    assert course.students(ASSIGNMENT) == {"anna": folder}


@pytest.mark.parametrize(
    ("name", "shown", "saw"),
    [
        (b"ann\xff", "'ann?'", "bytes that aren't UTF-8"),
        (b"a" * 201, f"'{'a' * 60}...'", "201 bytes, of at most 200"),
        (b"ann\nbob", r"'ann\nbob'", "more than one line"),
        (b"<img src=x onerror=alert(1)>", "'<img src=x onerror=alert(1)>'", "< and >"),  # in the formgrader
    ],
)
def test_a_folder_whose_name_can_t_be_used_is_left_out_and_named(course, name, shown, saw):
    course.submitted(os.fsdecode(name), ASSIGNMENT).mkdir(parents=True)
    assert list(course.students(ASSIGNMENT)) == ["anna", "bob", "eve"]
    problem = f"the folder's name has {saw}, so it is left out: rename it"
    assert course.odd_folders(ASSIGNMENT) == {shown: problem}
    for student in ("anna", "bob", "eve"):
        shutil.rmtree(course.submitted(student, ASSIGNMENT))
    with pytest.raises(CourseError) as failed:
        find_submissions(course, ASSIGNMENT)
    assert str(failed.value) == f"there is one submission of {ASSIGNMENT}, by {shown}: {problem}"


def test_outside_a_course_it_says_where_to_go(tmp_path):
    with pytest.raises(CourseError) as failed:
        Course(tmp_path)
    expected = f"expected nbgrader_config.py in {tmp_path}, saw none: go to the course's folder"
    assert str(failed.value) == expected


def test_a_configuration_that_fails_says_why(course):
    (course.root / "nbgrader_config.py").write_text("c.CourseDirectory.root = unknown")
    with pytest.raises(CourseError) as failed:
        Course(course.root)
    assert str(failed.value) == "nbgrader_config.py fails with NameError: name 'unknown' is not defined"


def test_a_timestamp_is_read_in_utc(tmp_path):
    (tmp_path / "timestamp.txt").write_text("2026-03-01T12:00:00+01:00\n")
    assert timestamp(tmp_path) == (datetime(2026, 3, 1, 11), "2026-03-01T12:00:00+01:00\n")


@pytest.mark.parametrize("content", [b"", b" \n", b"yesterday", b"\xff\xfe", b"9" * 300])
def test_a_timestamp_that_is_no_time_is_none(tmp_path, content):
    (tmp_path / "timestamp.txt").write_bytes(content)
    assert timestamp(tmp_path)[0] is None


def test_a_timestamp_that_is_no_ordinary_file_is_none_and_does_not_block(tmp_path):
    assert timestamp(tmp_path) == (None, "")
    (tmp_path / "real").write_text("2026-03-01")
    (tmp_path / "timestamp.txt").symlink_to("real")
    assert timestamp(tmp_path) == (None, "")
    (tmp_path / "timestamp.txt").unlink()
    os.mkfifo(tmp_path / "timestamp.txt")
    assert timestamp(tmp_path) == (None, "")


@pytest.mark.parametrize(
    ("text", "hour"),
    [("2026-03-01 12:00:00 +0200", 10), ("2026-03-01 12:00:00 -01:30", 13), ("2026-03-01 12:00:00 UTC", 12)],
)
def test_an_offset_is_in_hours_and_not_in_seconds(tmp_path, text, hour):
    (tmp_path / "timestamp.txt").write_text(text)
    assert timestamp(tmp_path)[0].hour == hour
    assert time_problem(tmp_path) == ""


NO_TIME = "which is not a time, so nothing counts as late: write one such as 2026-03-01 18:00:00 +0100"
FAR = "which is far in the future, so nothing counts as late: correct it"


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("yesterday", f"timestamp.txt has 'yesterday', {NO_TIME}"),
        ("2026-03-01 12:00 Mars/Base", f"timestamp.txt has '2026-03-01 12:00 Mars/Base', {NO_TIME}"),
        ("9999-01-01 00:00:00 UTC", f"timestamp.txt has '9999-01-01 00:00:00 UTC', {FAR}"),
    ],
)
def test_a_time_that_can_t_be_used_is_named(tmp_path, text, problem):
    (tmp_path / "timestamp.txt").write_text(text)
    assert time_problem(tmp_path) == problem
    assert timestamp(tmp_path) == (None, "")


def test_folders_that_begin_with_a_dot_are_known(course):
    course.submitted(".hidden", ASSIGNMENT).mkdir(parents=True)
    assert course.hidden_students(ASSIGNMENT) == [".hidden"]
    assert ".hidden" not in course.students(ASSIGNMENT)
