"""`python -m grader due`: due dates and extensions in local time, and what being late costs."""
import json
import time

import pytest
from nbgrader.api import Gradebook

from grader.marking.command.mark_class import Settings, mark_class
from grader.marking.gradebook.book import Book
from grader.marking.gradebook.course import Course
from tests.marking.classroom import ASSIGNMENT
from tests.marking.fake_pool import ReadyPool
from tests.marking.marked_class import marked, say  # noqa: F401


@pytest.fixture(autouse=True)
def berlin(monkeypatch):
    """The tests are in Berlin, where it is UTC+1 in winter."""
    with monkeypatch.context() as patch:
        patch.setenv("TZ", "Europe/Berlin")
        time.tzset()
        yield
    time.tzset()


def mark(course):
    return mark_class(course, ASSIGNMENT, Settings(), ReadyPool(course, marked).open)


def test_dates_are_local_are_listed_and_are_on_the_start_page(course, say):  # noqa: F811
    assert say("due") == (0, f"{ASSIGNMENT}: no due date\n", "")
    reported = f"{ASSIGNMENT}: Tue 1 December 2026, 18:00 CET\n"
    assert say("due", ASSIGNMENT, "2026-12-01 18:00") == (0, reported, "")
    with Book(course) as book:
        assert str(book.due_dates()[ASSIGNMENT]) == "2026-12-01 17:00:00"
    due = course.root / "course" / "due.json"
    assert json.loads(due.read_text()) == {ASSIGNMENT: "2026-12-01T17:00:00"}
    more = "  anna: Thu 2 July 2026, 20:00 CEST\n"
    reported = f"{ASSIGNMENT}: Wed 1 July 2026, 20:00 CEST\n"
    assert say("due", ASSIGNMENT, "2026-07-01 18:00+00:00") == (0, reported, "")
    assert say("due", ASSIGNMENT, "2026-07-02 20:00", "--student", "anna") == (0, reported + more, "")
    assert say("due", ASSIGNMENT, "none", "--student", "anna") == (0, reported, "")
    assert say("due", ASSIGNMENT, "none") == (0, f"{ASSIGNMENT}: no due date\n", "")
    assert json.loads(due.read_text()) == {}


def test_a_deadline_with_an_extension_costs_what_the_page_says(course, say):  # noqa: F811
    with open(course.root / "nbgrader_config.py", "a") as file:
        file.write("c.LateDays.percent_per_day = 10\n")
    course = Course(course.root)  # they handed in on 1 January 2026, at 10:00 UTC
    assert say("due", ASSIGNMENT, "2025-12-30 18:00")[0] == 0
    assert say("due", ASSIGNMENT, "2025-12-31 18:00", "--student", "anna")[0] == 0
    outcome = mark(course)
    assert outcome.due == f"{ASSIGNMENT} is due on Tue 30 December 2025, 18:00 CET."
    late = {who: (round(each.days_late, 2), each.penalty) for who, each in outcome.standings.items()}
    assert late == {"anna": (0.71, 1.0), "bob": (1.71, 0.0), "eve": (1.71, 2.0)}
    page = (course.feedback("anna", ASSIGNMENT) / "nodes.html").read_text()
    reported = "handed in 17 hours after Wed 31 December 2025, 18:00 CET, which costs 1 points"
    assert reported in page
    assert say("due", ASSIGNMENT, "none", "--student", "anna")[0] == 0
    assert mark(course).standings["anna"].penalty == 2.0
    assert say("due", ASSIGNMENT, "2026-01-01 11:00")[0] == 0
    assert {each.days_late for each in mark(course).standings.values()} == {0.0}
    assert "handed in" not in (course.feedback("anna", ASSIGNMENT) / "nodes.html").read_text()


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ((ASSIGNMENT, "soon"), "expected day and time such as 2026-12-01 18:00, saw 'soon'"),
        ((ASSIGNMENT, "2026-12-01"), "expected day and time such as 2026-12-01 18:00, saw '2026-12-01'"),
        (("nodes", "2026-12-01 18:00"), f"the gradebook doesn't know nodes: it has {ASSIGNMENT}"),
        (
            (ASSIGNMENT, "2026-12-01 18:00", "--student", "anna"),
            f"{ASSIGNMENT} has no due date that could be extended: set one first",
        ),
    ],
)
def test_what_can_t_be_set_is_named(course, say, words, sentence):  # noqa: F811
    assert say("due", *words) == (1, "", f"Nothing was changed: {sentence}.\n")


def test_an_extension_for_a_student_who_is_not_known_is_refused(course, say):  # noqa: F811
    say("due", ASSIGNMENT, "2026-12-01 18:00")
    why = "there is no student ana: did you mean anna?"
    answer = say("due", ASSIGNMENT, "2026-12-02 18:00", "--student", "ana")
    assert answer == (1, "", f"Nothing was changed: {why}\n")
    why = "there is no student nora: a new one is added with `nbgrader db student add nora`"
    answer = say("due", ASSIGNMENT, "2026-12-02 18:00", "--student", "nora")
    assert answer == (1, "", f"Nothing was changed: {why}.\n")
    with Gradebook(course.database) as book:
        book.add_student("nora")
    assert say("due", ASSIGNMENT, "2026-12-02 18:00", "--student", "nora")[0] == 0
    with Gradebook(course.database) as book:
        book.remove_student("nora")
    assert "nora" not in say("due", ASSIGNMENT, "none", "--student", "nora")[1]


def test_an_extension_is_no_earlier_date(course, say):  # noqa: F811
    say("due", ASSIGNMENT, "2026-12-01 18:00")
    why = f"an extension ends after {ASSIGNMENT} is due, which is Tue 1 December 2026, 18:00 CET"
    answer = say("due", ASSIGNMENT, "2026-11-01 18:00", "--student", "anna")
    assert answer == (1, "", f"Nothing was changed: {why}.\n")


def test_a_damaged_file_of_extensions_is_named(course, say):  # noqa: F811
    file = course.root / "class" / "extensions.json"
    file.write_text("[]")
    why = "'list' object has no attribute 'items'): correct it, or delete it and enter the extensions again"
    status, _, wrong = say("due")
    assert (status, wrong) == (1, f"Nothing was changed: {file} can't be read ({why}.\n")


def test_an_assignment_without_a_time_is_not_enough(course, say, capsys):  # noqa: F811
    with pytest.raises(SystemExit, match="2"):
        say("due", ASSIGNMENT)
    assert capsys.readouterr().err.endswith("error: expected the time after the assignment\n")


def test_a_folder_that_can_t_be_written_is_named(course, say):  # noqa: F811
    (course.root / "course").write_text("a file")
    reported = f"Stopped: {course.root / 'course'} can't be written (File exists).\n"
    assert say("due", ASSIGNMENT, "2026-12-01 18:00") == (1, "", reported)
