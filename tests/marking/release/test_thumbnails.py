"""`python -m grader.marking.release.thumbnails` draws what the lessons show."""

from pathlib import Path

import nbformat
import pytest

from grader.course_files.course_notebooks import picture_of
from grader.marking.errors import CommandFailed
from grader.marking.release import thumbnails

ROOT = Path(__file__).parents[3]
LESSONS = [f"{path.parent.name}/{path.stem}" for path in sorted(ROOT.glob(thumbnails.LESSONS))]
QUICK = ("00_robot/lesson", "01_nodes/lesson")


def lesson(*sources: str) -> list[nbformat.NotebookNode]:
    cells = [nbformat.v4.new_code_cell(source) for source in sources]
    for number, cell in enumerate(cells):
        cell.id = f"goal-{number}"
    return cells


@pytest.mark.parametrize(
    "name", [name if name in QUICK else pytest.param(name, marks=pytest.mark.soak) for name in LESSONS]
)
def test_the_picture_of_a_lesson_is_that_of_its_goal(name):
    notebook = ROOT / "course" / f"{name}.ipynb"
    assert thumbnails.draw_goal(notebook) == picture_of(notebook).read_text("utf-8")


@pytest.mark.parametrize(
    ("source", "shown"),
    [
        ("run(A).replay(speed=2)", ("run(A)", "world")),
        ("recording = run(A)\nplot_graph(recording)", ("recording", "graph")),
        ("animate(run(A), speed=2)", ("run(A)", "world")),
    ],
)
def test_the_last_line_of_a_cell_gives_the_recording(source, shown):
    assert thumbnails.find_goal("99_new", lesson("x = 1", "%magic", source)) == (2, *shown)


def test_a_lesson_without_a_goal_is_named():
    must = "must end with a replay or a plot of a recording"
    with pytest.raises(CommandFailed) as error:
        thumbnails.find_goal("99_new", lesson("x = 1", "print(x)", ""))
    assert str(error.value) == f'99_new has no picture: a cell whose id begins with "goal" {must}'
    with pytest.raises(CommandFailed) as error:
        thumbnails.find_goal("02_topics/connecting", lesson("plot_graph(x)"))
    assert str(error.value) == f"02_topics/connecting has no picture: the cell 'together-topics' {must}"


def test_a_goal_that_cannot_be_run_is_reported(tmp_path, monkeypatch, capsys):
    folder = tmp_path / "course" / "99_new"
    folder.mkdir(parents=True)
    nbformat.write(nbformat.v4.new_notebook(cells=lesson("plot_logs(1 / 0)")), folder / "lesson.ipynb")
    monkeypatch.chdir(tmp_path)
    assert thumbnails.main(["99_new"]) == 1
    wrong = f"{Path('course/99_new/lesson.ipynb')} shows no goal: ZeroDivisionError: division by zero\n"
    assert capsys.readouterr().err == wrong
