import nbformat
import pytest

from grader.marking.command.mark_class import Settings, mark_class
from grader.marking.gradebook import feedback
from grader.marking.gradebook.feedback import is_stale, make_feedback
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
    monkeypatch.setattr(feedback, "FEW", 2)
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
