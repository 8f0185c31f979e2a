import re
from pathlib import Path
from xml.etree import ElementTree

import nbformat
import pytest

from grader import Missed, check
from grader.checks.verdicts import judge
from grader.marking.release import run_notebooks, run_solutions
from grader.marking.release.run_notebooks import ExecutedNotebook, TestCellMark, missed_lines
from grader.marking.release.run_solutions import junit, main
from grader.score import Score
from sim.evidence import Recording
from tests.marking.tiny import ROOT, grade

HALF = """
from grader import Exercise, Missed
import rclpy.node
it = Exercise("it", "A node", seconds=1)
@it.check(2)
def lives(run):
    "The node lives."
@it.check(3)
def speaks(run):
    "The node speaks."
    raise Missed("1 < 2 words", "none", "Say something.")
it.grade(lambda: rclpy.node.Node("node"))
"""


def write(path: Path, *cells: nbformat.NotebookNode) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    nbformat.write(nbformat.v4.new_notebook(cells=list(cells)), path)


def code(source: str, name: str) -> nbformat.NotebookNode:
    return nbformat.v4.new_code_cell(source, id=name)


def without_seconds(text: str) -> str:
    return re.sub(r" +\d+$", "", text, flags=re.M)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_what_is_right_is_a_line_with_its_points_and_leaves_no_file(folder, capsys):
    (folder / "course" / "01").mkdir(parents=True)
    (folder / "course" / "01" / "goal.py").write_text("GOAL = 1\n")
    write(folder / "course" / "01" / "lesson.ipynb", code("import goal\nopen('my_file', 'w').close()", "a"))
    write(folder / "solutions" / "01" / "a.ipynb", grade("one", 2, "2.0"), grade("two", 1.5, "assert True"))
    assert main([]) == 0
    assert without_seconds(capsys.readouterr().out) == (
        "Running 2 notebooks ...\n"
        "                              points       s\n"
        "course/01/lesson.ipynb             -\n"
        "solutions/01/a.ipynb      3.5 of 3.5\n"
        "all                       3.5 of 3.5\n"
    )
    assert sorted(path.name for path in folder.rglob("*.*")) == ["a.ipynb", "goal.py", "lesson.ipynb"]


def test_what_was_missed_is_reported_and_ends_with_1(folder, capsys):
    write(folder / "solutions" / "a.ipynb", code("1 / 0", "start"), grade("half", 5, HALF))
    assert main(["solutions", "--junit", "found.xml"]) == 1
    missed = capsys.readouterr().out.split("\n\n")[1]
    assert missed == (
        "Missed:\n"
        "solutions/a.ipynb: cell start: ZeroDivisionError: division by zero\n"
        "solutions/a.ipynb, half: 2 of 5 points\n"
        "    ✘ missed\n"
        "    The node speaks.\n"
        "    Expected: 1 < 2 words\n"
        "    Saw: none\n"
        "    Hint: Say something.\n"
        "    0 / 3\n"
    )
    (suite,) = ElementTree.parse(folder / "found.xml").getroot()
    assert (suite.get("name"), suite.get("tests"), suite.get("failures")) == ("solutions/a.ipynb", "2", "2")
    whole, half = suite.iter("testcase")
    assert whole[0].text == "cell start: ZeroDivisionError: division by zero"
    assert (half.get("name"), half[0].get("message")) == ("half", "2 of 5 points")
    assert "The node speaks.\nExpected: 1 < 2 words" in half[0].text


def test_a_cell_that_is_stopped_is_named_and_the_rest_goes_on(folder, capsys, monkeypatch):
    monkeypatch.setattr(run_notebooks, "SECONDS_PER_CELL", 1)
    write(folder / "a.ipynb", code("while True: pass", "loop"), grade("one", 1, "1.0"))
    assert main(["a.ipynb"]) == 1
    out = capsys.readouterr().out
    assert out.split("\n\n")[1] == "Missed:\na.ipynb: cell loop: stopped after 1 s\n"
    assert "1 of 1" in out


def test_a_kernel_that_dies_leaves_nothing_for_what_it_did_not_reach(folder, capsys):
    dies = code("import os; os._exit(3)", "dies")
    write(folder / "a.ipynb", grade("one", 1, "1.0"), dies, grade("two", 1, "1"))
    assert main(["a.ipynb"]) == 1
    assert capsys.readouterr().out.split("\n\n")[1] == (
        "Missed:\na.ipynb: its kernel died.\na.ipynb, two: 0 of 1 points\n"
    )


def test_a_folder_that_is_not_there_is_named(folder, capsys):
    assert main(["solutions"]) == 2
    assert capsys.readouterr().err == (
        "Expected a notebook or a folder of notebooks at solutions, saw nothing there.\n"
    )


def test_only_lines_that_cost_points_are_missed():
    @check(points=1)
    def right(run):
        """It is right."""

    @check(points=1)
    def wrong(run):
        """It is so."""
        raise Missed("a < b", "b", "Turn it.")

    @check(points=1, after=wrong)
    def later(run):
        """It is later."""

    score = Score("it", judge([right, wrong, later], Recording()))
    lines = missed_lines(score._repr_html_())
    assert lines[:6] == ["✘ missed", "It is so.", "Expected: a < b", "Saw: b", "Hint: Turn it.", "0 / 1"]
    assert lines[6:8] == ["○ skipped", "It is later."]
    assert missed_lines("") == []


def test_junit_counts_what_is_right():
    suite = ElementTree.fromstring(junit([ExecutedNotebook(Path("a"), 2.0, (TestCellMark("one", 1, 1),))]))[0]
    assert (suite.get("tests"), suite.get("failures"), suite.get("time")) == ("2", "0", "2.0")
    assert list(suite.iter("failure")) == []


def test_everything_is_run_when_nothing_is_named():
    assert [str(folder) for folder in run_solutions.FOLDERS] == ["course", "solutions"]


def test_the_start_page_finds_what_it_maps():
    assert run_notebooks.run_notebook(ROOT / "course" / "start.ipynb").problems == ()
