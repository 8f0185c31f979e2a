import os
from dataclasses import replace

import nbformat
import pytest

from grader.marking.gradebook.marked_notebooks import (
    is_shown,
    marked_notebooks,
    notice,
    write_notebooks,
)
from grader.marking.journal import JournalEntry
from tests.marking.classroom import ASSIGNMENT, result, submit, tasks

TIME = "2026-01-01 10:00:00 UTC"
LOOK = "Your notebook was repaired before it was marked. Please check that this is your work:"
STOPPED = "Your notebook stopped. A cell in which it stopped earns nothing; the others count."
NOTICES = [
    ({"verdict": "marked", "flags": ["It is odd."]}, ""),
    ({"verdict": "repaired", "repairs": ["One.", "Two\nlines."]}, f"{LOOK}\n\n- One.\n- Two lines."),
    (
        {"verdict": "stopped", "reason": "The cell `x`\nran on.", "flags": ["It is odd."]},
        f"{STOPPED}\n\nThe cell `x` ran on.",
    ),
    (
        {"verdict": "stopped", "reason": "It ran on.", "repairs": ["One."]},
        f"{STOPPED}\n\nIt ran on.\n\nIt was repaired first:\n\n- One.",
    ),
    (
        {"verdict": "refused", "reason": "It is empty.", "notebooks": []},
        "Your submission could not be marked.\n\nIt is empty.",
    ),
]


@pytest.fixture
def task(course):
    return tasks(course)[0]


@pytest.mark.parametrize(("changes", "words"), NOTICES)
def test_the_notice_reports_what_was_done_to_the_submission_and_no_flags(course, task, changes, words):
    heading = "**How this was marked**\n\n" if words else ""
    assert notice(result(course, task, **changes)) == heading + words


def test_the_notice_stands_on_top_of_the_notebook(course, task):
    entry = JournalEntry("ab12", result(course, task, verdict="repaired", repairs=["One."]))
    notebook = marked_notebooks(entry, task.release)["nodes"]
    nbformat.validate(notebook)
    assert notebook.cells[0].source == notice(entry.result)
    assert notebook.cells[1:] == nbformat.from_dict(entry.result.notebooks[0].notebook).cells
    assert len(marked_notebooks(entry, task.release)["nodes"].cells) == len(notebook.cells)


def test_a_refused_submission_shows_what_was_to_be_done(course, task):
    entry = JournalEntry("ab12", result(course, task, verdict="refused", reason="It is empty.", notebooks=[]))
    notebook = marked_notebooks(entry, task.release)["nodes"]
    assert [cell.id for cell in notebook.cells[:3]] == ["how-this-was-marked", "set-up", "counter"]


def test_the_notebooks_say_which_marking_they_show(course, task):
    entry = JournalEntry("ab12", result(course, task))
    assert not is_shown(course, entry, ["nodes"])
    write_notebooks(course, entry.result, marked_notebooks(entry, task.release), "")
    assert is_shown(course, entry, ["nodes"])
    assert not is_shown(course, replace(entry, id="other"), ["nodes"])
    assert not is_shown(course, entry, ["nodes", "more"])
    file = course.autograded("anna", ASSIGNMENT) / "nodes.ipynb"
    file.unlink()
    file.write_text("torn")
    assert not is_shown(course, entry, ["nodes"])


def test_the_folder_holds_what_was_marked_and_the_time_and_nothing_else(course, task):
    folder = course.autograded("anna", ASSIGNMENT)
    folder.mkdir(parents=True)
    (folder / "old.ipynb").write_text("from another marking")
    entry = JournalEntry("ab12", result(course, task))
    for _ in range(2):
        write_notebooks(course, entry.result, marked_notebooks(entry, task.release), TIME)
        assert sorted(path.name for path in folder.iterdir()) == ["nodes.ipynb", "timestamp.txt"]
        assert {os.stat(path).st_mode & 0o777 for path in folder.iterdir()} == {0o444}
    assert (folder / "timestamp.txt").read_text() == TIME
    write_notebooks(course, entry.result, marked_notebooks(entry, task.release), "")
    assert [path.name for path in folder.iterdir()] == ["nodes.ipynb"]


def test_a_course_of_several_instructors_lets_its_group_write(course, task):
    course.directory.groupshared = True
    entry = JournalEntry("ab12", result(course, task))
    write_notebooks(course, entry.result, marked_notebooks(entry, task.release), "")
    assert os.stat(course.autograded("anna", ASSIGNMENT) / "nodes.ipynb").st_mode & 0o777 == 0o664


def test_a_student_with_an_odd_name_has_a_page(course):
    submit(course, "x [1]")
    task = next(task for task in tasks(course) if task.student == "x [1]")
    entry = JournalEntry("ab12", result(course, task))
    write_notebooks(course, entry.result, marked_notebooks(entry, task.release), "")
    assert is_shown(course, entry, ["nodes"])
