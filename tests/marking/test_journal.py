import json
import os

import pytest

from grader.marking.errors import CourseError
from grader.marking.journal import Journal
from tests.marking.classroom import ASSIGNMENT, result, tasks


@pytest.fixture
def task(course):
    return tasks(course)[0]


@pytest.fixture
def journal(course):
    return Journal(course.journal(ASSIGNMENT))


def test_a_result_that_is_stored_is_found(course, journal, task):
    kept = journal.save(result(course, task))
    assert journal.find("anna", task.key) == kept
    assert [path.name for path in journal.folder.iterdir()] == ["anna.json"]
    assert os.stat(journal.folder / "anna.json").st_mode & 0o777 == 0o600


def test_every_marking_has_an_id_of_its_own(course, journal, task):
    first, second = (journal.save(result(course, task)) for _ in range(2))
    assert first.result == second.result
    assert first.id != second.id
    assert journal.find("anna", task.key) == second


def test_a_file_that_is_torn_anywhere_counts_as_none(course, journal, task):
    journal.save(result(course, task))
    file = journal.folder / "anna.json"
    whole = file.read_bytes()
    for end in [*range(0, 200, 7), *range(200, len(whole) - 1, len(whole) // 40)]:
        file.write_bytes(whole[:end])
        assert journal.find("anna", task.key) is None, end
    file.write_bytes(whole.replace(b'"points"', b'"paints"', 1))
    assert journal.find("anna", task.key) is None


def test_a_result_of_another_submission_counts_as_none(course, journal, task):
    journal.save(result(course, task))
    (course.submitted("anna", ASSIGNMENT) / "nodes.ipynb").write_text("changed")
    assert journal.find("anna", tasks(course)[0].key) is None
    (journal.folder / "anna.json").rename(journal.folder / "bob.json")
    assert journal.find("bob", task.key) is None


def test_what_is_forgotten_is_marked_again(course, journal, task):
    journal.save(result(course, task))
    journal.discard(["anna", "unknown"])
    assert journal.find("anna", task.key) is None


def test_two_cannot_mark_the_same_assignment_at_once(journal):
    with journal.hold_lock(), pytest.raises(CourseError) as refused, journal.hold_lock():
        pass
    expected = f"process {os.getpid()} is already marking {ASSIGNMENT}: wait for it, or stop it with Ctrl-C"
    assert str(refused.value) == expected
    with journal.hold_lock():
        pass


def test_settings_are_kept_and_nonsense_counts_as_none(journal):
    assert journal.settings() is None
    journal.save_settings({"jobs": 3})
    assert journal.settings() == {"jobs": 3}
    for nonsense in ("", "3", json.dumps([1])):
        (journal.folder / ".settings.json").write_text(nonsense)
        assert journal.settings() is None
