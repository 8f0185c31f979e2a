"""What holds for every lesson: it runs, and it has what a reader needs; and what the assignments say."""

import json
import re
from pathlib import Path

import pytest

from grader.course_files.course_notebooks import part_of
from tests.exercises.score_tables import graded_exercises, notebook_run

ROOT = Path(__file__).parents[2]
WIDGET = "application/vnd.jupyter.widget-view+json"
NOT_LIVE = ("interactive(", "VBox(", "OrderGame(")
LESSONS = sorted(ROOT.glob("course/[0-9]*/*.ipynb"))
NAMES = [f"{path.parent.name}/{path.stem}" for path in LESSONS]
# One that plays; `make solutions` runs every lesson for each change that is proposed.
EVERY_DAY = ("00_robot/lesson",)
RUNS = [name if name in EVERY_DAY else pytest.param(name, marks=pytest.mark.soak) for name in NAMES]
ASSIGNMENTS = sorted(path.parent.name for path in ROOT.glob("solutions/*/*.ipynb"))


def cells(folder, name):
    """The cells of an assignment, such as "01_nodes", or of a lesson, such as "01_nodes/lesson"."""
    (path,) = ROOT.glob(f"{folder}/{name}.ipynb" if "/" in name else f"{folder}/{name}/*.ipynb")
    return [(cell["id"], "".join(cell["source"])) for cell in json.loads(path.read_text("utf-8"))["cells"]]


def is_live(output):
    """Whether this is a live picture; sliders and buttons are widgets, too, but need no end."""
    data = output.get("data", {})
    return WIDGET in data and not data["text/plain"].startswith(NOT_LIVE)


@pytest.mark.parametrize("lesson", RUNS)
def test_a_lesson_runs_from_top_to_bottom(lesson):
    outputs = [output for cell in notebook_run("course", lesson).cells for output in cell.get("outputs", ())]
    assert outputs, "a lesson shows something"
    assert [output.evalue for output in outputs if output.output_type == "error"] == []
    assert not any(map(is_live, outputs)), "a picture that no one ends"


@pytest.mark.parametrize("lesson", RUNS)
def test_what_a_slider_shows_is_there_when_the_lesson_has_run(lesson):
    for cell in notebook_run("course", lesson).cells:
        if re.search(r"^@?interact\(", cell.source, re.M) and cell.cell_type == "code":
            shown = [output.data["text/plain"] for output in cell.outputs if "data" in output]
            sliders = [text for text in shown if text.startswith("interactive(")]
            assert len(sliders) == 1 and len(shown) > 1


@pytest.mark.parametrize("lesson", NAMES)
def test_no_source_shows_which_answer_of_a_prediction_is_right(lesson):
    for name, source in cells("course", lesson):
        (letters,) = re.findall(r"\.outcome\((.*)\)", source) or [""]
        assert not re.search(r"[\"'][a-d][\"']", letters), f"{name}: write the code that `outcome` names"


def test_every_assignment_has_a_lesson():
    assert {part_of(name) for name in ASSIGNMENTS} <= {part_of(path.parent.name) for path in LESSONS}


@pytest.mark.parametrize("lesson", NAMES)
def test_a_lesson_says_what_it_takes_and_where_to_read_on(lesson):
    texts = dict(cells("course", lesson))
    assert "**Time:**" in texts["title"] and "(../glossary.md)" in texts["title"]
    assert lesson == "00_robot/lesson" or "**Before you begin:**" in texts["title"]
    assert lesson == "00_robot/lesson" or "From lesson " in texts["check"], "a question on an earlier lesson"
    assert "**Read on" in texts["summary"] and "](https://" in texts["summary"]


@pytest.mark.parametrize("lesson", NAMES)
def test_a_lesson_shows_no_bad_habits(lesson):
    source = "\n".join(source for _, source in cells("course", lesson))
    assert "Node.__init__(" not in source.replace("super().__init__(", "")
    assert re.findall(r"Scan, \"/scan\w*\", \S+, 10\)", source) == [], "many lidars offer best effort only"
    links = re.findall(r"\]\((?!https://)([^)]+)\)", source)
    assert [link for link in links if not ((ROOT / "course" / lesson).parent / link).exists()] == []


@pytest.mark.parametrize("assignment", ASSIGNMENTS)
def test_an_assignment_says_its_time_and_ends_with_an_open_task(assignment):
    texts = dict(cells("solutions", assignment))
    head, first, *_ = texts["title"].split("\n\n")
    assert head.startswith("# Assignment ") and first.startswith("**Time:** about ")
    assert "course/glossary.md" in texts["title"]
    assert texts["open-task"].startswith("## One more, without points")


@pytest.mark.parametrize("assignment", ASSIGNMENTS)
def test_each_answer_is_explained_to_the_instructor_alone(assignment):
    text = (ROOT / "solutions" / assignment / "answers.md").read_text("utf-8")
    numbers = [int(number) for number in re.findall(r"^\*\*(\d+)\. ", text, re.M)]
    assert numbers == list(range(1, len(graded_exercises(assignment)) + 1))
    assert not (ROOT / "exercises" / assignment / "answers.md").exists()
