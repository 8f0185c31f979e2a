import re

import nbformat
import pytest
from nbconvert.exporters import HTMLExporter
from nbgrader.api import Gradebook

from grader.marking.command.mark_class import Settings, mark_class
from grader.marking.gradebook import feedback
from grader.marking.gradebook.feedback import is_stale, make_feedback
from grader.marking.judge import score_outputs
from tests.marking.classroom import ASSIGNMENT, result
from tests.marking.fake_pool import ReadyPool

ALL = ["anna", "bob", "eve"]
EVIL = "<script>steal()</script><img src=x onerror=steal()>"


@pytest.fixture
def marked(course):
    mark_class(course, ASSIGNMENT, Settings(feedback=False), ReadyPool(course).open)
    return course


def page(course, student):
    return course.feedback(student, ASSIGNMENT) / "nodes.html"


def test_a_page_is_stale_until_it_is_made_and_when_its_notebook_is_newer(marked):
    assert is_stale(marked, ASSIGNMENT, "anna")
    assert make_feedback(marked, ASSIGNMENT, ["anna"]) == []
    assert not is_stale(marked, ASSIGNMENT, "anna")
    assert is_stale(marked, ASSIGNMENT, "bob")
    notebook = marked.autograded("anna", ASSIGNMENT) / "nodes.ipynb"
    content = notebook.read_text()
    notebook.unlink()
    notebook.write_text(content)
    assert is_stale(marked, ASSIGNMENT, "anna")


def test_a_page_that_was_cut_off_is_stale(marked):
    make_feedback(marked, ASSIGNMENT, ["anna"])
    whole = page(marked, "anna").read_text()
    page(marked, "anna").write_text(whole[:-20])
    assert is_stale(marked, ASSIGNMENT, "anna")


@pytest.mark.soak
def test_several_processes_make_the_same_pages(marked, monkeypatch):
    assert make_feedback(marked, ASSIGNMENT, ALL) == []
    expected = [page(marked, student).read_text() for student in ALL]
    for student in ALL:
        page(marked, student).unlink()
    monkeypatch.setattr(feedback, "SHARE", 1)
    assert make_feedback(marked, ASSIGNMENT, ALL, jobs=2) == []
    assert [page(marked, student).read_text() for student in ALL] == expected


def test_what_a_submission_brings_never_runs_in_its_page(course):
    def evil(here, task):
        found = result(here, task, verdict="stopped", reason=EVIL, repairs=[EVIL, "[x](javascript:steal())"])
        shown = nbformat.v4.new_output("display_data", data={"text/html": EVIL, "text/plain": "x"})
        found.notebooks[0].notebook["cells"][2]["outputs"] = [shown]
        found.notebooks[0].notebook["cells"][-1]["source"] = EVIL
        return found

    def refused(here, task):
        return result(here, task, verdict="refused", reason=EVIL, notebooks=[])

    for change in (evil, refused):
        settings = Settings(students=["anna"], force=True)
        assert mark_class(course, ASSIGNMENT, settings, ReadyPool(course, change).open).problems == []
        shown = page(course, "anna").read_text()
        assert "How this was marked" in shown
        for running in ("<script>steal", "onerror", 'href="javascript:'):
            assert running not in shown


def picture_missing(here, task):
    found = result(here, task)
    pasted = "![my robot](attachment:image.png) <img src='attachment:x'>"
    found.notebooks[0].notebook["cells"][-1]["source"] = pasted
    return found


def test_a_missing_attachment_shows_its_words_and_stops_nothing(course):
    outcome = mark_class(course, ASSIGNMENT, Settings(), ReadyPool(course, picture_missing).open)
    assert outcome.problems == []
    for student in ALL:
        assert '<img alt="my robot" src="data:image/png;base64,"/>' in page(course, student).read_text()


def test_what_was_written_in_private_worlds_is_not_on_the_students_page(course):
    def private(here, task):
        found = result(here, task)
        shown = score_outputs.for_instructor("the wall is at 3.7 m\n")
        found.notebooks[0].notebook["cells"][2]["outputs"] = shown
        return found

    mark_class(course, ASSIGNMENT, Settings(), ReadyPool(course, private).open)
    assert "3.7" not in page(course, "anna").read_text()
    notebook = nbformat.read(course.autograded("anna", ASSIGNMENT) / "nodes.ipynb", 4)
    formgrader = HTMLExporter(config=course.app.config)
    shown, _ = formgrader.from_notebook_node(notebook)
    assert "Written in private worlds; not on the student's page:\nthe wall is at 3.7 m\n" in shown


def test_a_page_has_a_name_and_contents_and_loads_nothing(marked):
    with Gradebook(marked.database, marked.name) as book:
        book.update_or_create_student("anna", first_name="Anna", last_name="<b>Meier")
        comment = book.find_comment("essay", "nodes", ASSIGNMENT, "anna")
        comment.manual_comment = "Well *said*."
        book.db.commit()
    make_feedback(marked, ASSIGNMENT, ["anna"])
    shown = page(marked, "anna").read_text()
    assert '<html lang="en">' in shown
    assert "<title>Anna &lt;b&gt;Meier (anna): 01_class, nodes</title>" in shown
    line = r'<tr><td><a href="(.*?)">(.*?)</a></td><td>(?:[\d.]+ of )?(.*?)</td></tr>'
    assert re.findall(line, shown) == [
        ("#test_counter", "test_counter", "4"),
        ("#test_line", "test_line", "6"),
        ("#essay", "essay", "5"),
        ("#comment-essay", "Comment on essay", ""),
    ]
    assert 'id="comment-essay"><b>Comment</b> <p>Well <em>said</em>.</p>' in shown
    for name in ("test_counter", "test_line", "essay"):
        assert shown.count(f'id="{name}"') == 1
    assert re.findall(r"""(?:src|href|url)\s*[=(]\s*["']?(?!#|data:)([^"')>\s]+)""", shown) == []
