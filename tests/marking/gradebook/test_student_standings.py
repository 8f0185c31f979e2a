"""What instructors change in the gradebook after marking: points, comments, due dates."""
import csv
from datetime import datetime, timedelta

import pytest
from nbgrader.api import Gradebook

from grader.marking.command.mark_class import Settings, mark_class
from grader.marking.release.nbgrader_command import nbgrader
from tests.marking.classroom import ASSIGNMENT
from tests.marking.fake_pool import ReadyPool
from tests.marking.marked_class import marked

LATE = """
from nbgrader.plugins import LateSubmissionPlugin
class APointADay(LateSubmissionPlugin):
    def late_submission_penalty(self, student_id, score, total_seconds_late):
        return total_seconds_late / 86400
c.AssignLatePenalties.plugin_class = APointADay
"""


@pytest.fixture
def again(course):
    """Marks the class, and says which students' pages were made."""

    def run():
        pages = {who: course.feedback(who, ASSIGNMENT) / "nodes.html" for who in ("anna", "bob", "eve")}
        before = {who: page.stat().st_mtime_ns if page.exists() else 0 for who, page in pages.items()}
        outcome = mark_class(course, ASSIGNMENT, Settings(), ReadyPool(course, marked).open)
        return outcome, [who for who, page in pages.items() if page.stat().st_mtime_ns != before[who]]

    assert run()[1] == ["anna", "bob", "eve"]
    return run


def change(course, alter) -> None:
    with Gradebook(course.database, course.name) as book:
        alter(book)
        book.db.commit()


def test_points_and_comments_by_hand_are_in_the_summary_and_on_a_new_page(course, again):
    assert again()[1] == []

    def alter(book):
        note = book.find_submission(ASSIGNMENT, "anna").notebooks[0]
        next(each for each in note.grades if each.name == "essay").manual_score = 4.5
        next(each for each in note.comments if each.name == "essay").manual_comment = "Well argued"

    change(course, alter)
    outcome, made = again()
    assert (outcome.fresh, made) == ([], ["anna"])
    standing = outcome.standings["anna"]
    assert standing.points["nodes", "essay"] == 4.5
    assert (standing.by_hand, standing.comments) == (
        frozenset({("nodes", "essay")}),
        ((("nodes", "essay"), "Well argued"),),
    )
    assert "Well argued" in (course.feedback("anna", ASSIGNMENT) / "nodes.html").read_text()
    assert again()[1] == []


def test_a_due_date_that_is_set_or_moved_after_marking_counts(course, again):
    with open(course.root / "nbgrader_config.py", "a") as file:
        file.write(LATE)
    course.__init__(course.root)
    due = datetime(2025, 12, 30, 10)  # they handed in on 1 January at 10:00
    change(course, lambda book: book.update_or_create_assignment(ASSIGNMENT, duedate=due))
    outcome, made = again()
    assert (outcome.fresh, made) == ([], ["anna", "bob", "eve"])
    assert (outcome.standings["anna"].penalty, outcome.standings["anna"].days_late) == (2.0, 2.0)
    change(course, lambda book: book.grant_extension(ASSIGNMENT, "anna", days=1))
    outcome, made = again()
    assert made == ["anna"]
    assert (outcome.standings["anna"].penalty, outcome.standings["bob"].days_late) == (1.0, 2.0)
    change(course, lambda book: book.update_or_create_assignment(ASSIGNMENT, duedate=due + timedelta(days=2)))
    outcome, made = again()
    assert made == ["anna", "bob", "eve"]
    assert {each.penalty for each in outcome.standings.values()} == {0.0}


def test_hidden_folders_and_times_that_are_none_are_noted(course, again):
    course.submitted(".hidden", ASSIGNMENT).mkdir(parents=True)
    (course.submitted("bob", ASSIGNMENT) / "timestamp.txt").write_text("soon")
    why = "so nothing counts as late: write one such as 2026-03-01 18:00:00 +0100"
    assert again()[0].notes == [
        (".hidden", "the folder's name begins with a dot, so it is skipped: rename it"),
        ("bob", f"timestamp.txt has 'soon', which is not a time, {why}"),
    ]


def test_the_export_quotes_names_and_runs_no_formula(course, again):
    name = {"last_name": 'Doe, "Jane"', "first_name": "=1+1"}
    change(course, lambda book: book.update_or_create_student("bob", **name))
    nbgrader(course.root, "export")
    text = (course.root / "class" / "grades.csv").read_text()
    rows = {row["student_id"]: row for row in csv.DictReader(text.splitlines())}
    assert (rows["bob"]["last_name"], rows["bob"]["first_name"]) == ('Doe, "Jane"', "'=1+1")
    assert (rows["anna"]["score"], rows["anna"]["max_score"], rows["bob"]["score"]) == ("10.0", "15.0", "0.0")
    nbgrader(course.root, "export", "--to", "x.csv", "--CsvExportPlugin.student=['anna']")
    assert (course.root / "x.csv").read_text().count("\n") == 2
