"""The web site: what it is built from."""

import json
from pathlib import Path

import nbformat
import pytest
from ipywidgets import FloatSlider, IntSlider

from grader.marking.errors import CommandFailed
from grader.marking.release import make_site, site_pages, site_sliders
from grader.marking.release.site_sliders import recorded, sampled

REPLAY = """
from rclpy.node import Node
from sim import run
run(lambda: Node("still"), world="room", seconds=2).replay()
"""
MAP = """
from IPython.display import HTML
HTML('<a href="../course/01_nodes/lesson.ipynb">Lesson 1</a> <a href="https://a.org/b.ipynb">b</a>')
"""
PREDICT = """
from sim.view import predict
guess = predict("How many wheels has it?", a="two", b="three")
"""
SLIDER = """
from ipywidgets import IntSlider, interact
@interact(wheels=IntSlider(2, min=1, max=4))
def count(wheels):
    print(f"{wheels} wheels")
"""
OUTCOME = 'guess.outcome("a")'
CELLS = (REPLAY, MAP, PREDICT, OUTCOME, SLIDER)
LESSON = """# Lesson one

$$\\frac{1}{2}$$

A program that **waits** for [words](../glossary.md).

**Time:** about 90 minutes."""
TEXTS = {
    "course/glossary.md": "# Glossary\n\n| a | b | |\n|--|--|--:|\n| **program** | a file | 1 |\n",
    "course/real_robot.md": "# A real robot\n",
    "course/TUTOR.md": "# A tutor\n",
    "pyproject.toml": "",
}


def notebook(*cells: nbformat.NotebookNode) -> str:
    for number, cell in enumerate(cells):
        cell.id = f"cell-{number}"
        if cell.source in (PREDICT, OUTCOME):
            cell.metadata.jupyter = {"source_hidden": True}
    return nbformat.writes(nbformat.v4.new_notebook(cells=list(cells)))


@pytest.fixture
def course(tmp_path: Path) -> Path:
    """A course with a start page, a lesson and a task."""
    return small_course(tmp_path)


def small_course(folder: Path) -> Path:
    """Write a course with a start page, a lesson and a task; return its folder."""
    code, text = nbformat.v4.new_code_cell, nbformat.v4.new_markdown_cell
    notebooks = {
        "course/start.ipynb": (text("# Start"), code("raise SystemExit('not executed')")),
        "course/01_nodes/lesson.ipynb": (text(LESSON), *map(code, CELLS)),
        "exercises/01_nodes/nodes.ipynb": (text("# Task one"), code("raise SystemExit('not executed')")),
    }
    for name, content in (TEXTS | {name: notebook(*cells) for name, cells in notebooks.items()}).items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(content)
    return folder


def test_lessons_are_executed_and_tasks_are_not(course, tmp_path_factory):
    pages, lines = tmp_path_factory.mktemp("pages"), []
    make_site.write_pages(course, pages, pages / "kept", [], lines.append)
    assert lines == ["course/01_nodes/lesson.ipynb"]
    names = "course/01_nodes/lesson.ipynb", "exercises/01_nodes/nodes.ipynb"
    (_, lesson, links, guess, *_), (_, task) = (
        json.loads((pages / name).read_text())["cells"] for name in names
    )
    assert "<script" in "".join(lesson["outputs"][0]["data"]["text/html"])
    assert task["outputs"] == [] and not (pages / "course" / "start.ipynb").exists()
    assert "remove-input" in guess["metadata"]["tags"]
    page = "".join(links["outputs"][0]["data"]["text/html"])
    assert 'href="../course/01_nodes/lesson.html"' in page and 'href="https://a.org/b.ipynb"' in page
    index = (pages / "index.md").read_text()
    names = ["course/glossary", "course/real_robot", "course/TUTOR", "course/01_nodes/lesson"]
    assert [line for line in index.splitlines() if "/" in line] == [*names, "exercises/01_nodes/nodes"]


def test_the_pages_after_the_lessons_have_a_list_of_their_own(course, tmp_path_factory):
    pages = tmp_path_factory.mktemp("pages")
    (course / "course" / "bridge").mkdir()
    page = notebook(nbformat.v4.new_markdown_cell("# A"))
    (course / "course" / "bridge" / "01_ros1.ipynb").write_text(page)
    make_site.write_pages(course, pages, pages / "kept", ["no_such_lesson"], print)
    lists = (pages / "index.md").read_text().split(":caption: ")[1:]
    entries = {name: [line for line in lines if "/" in line] for name, *lines in map(str.splitlines, lists)}
    assert entries["Lessons"] == ["course/01_nodes/lesson"]
    assert entries["Other systems"] == ["course/bridge/01_ros1"]


def test_one_lesson_is_executed_on_request(course, tmp_path_factory):
    pages, lines = tmp_path_factory.mktemp("pages"), []
    make_site.write_pages(course, pages, pages / "kept", ["no_such_lesson"], lines.append)
    assert lines == []


def test_a_lesson_whose_kernel_dies_is_named(course, tmp_path_factory):
    lesson = course / "course" / "01_nodes" / "lesson.ipynb"
    lesson.write_text(notebook(nbformat.v4.new_code_cell("import os; os._exit(1)")))
    pages = tmp_path_factory.mktemp("pages")
    with pytest.raises(CommandFailed) as raised:
        make_site.write_pages(course, pages, pages / "kept", [], print)
    assert str(raised.value) == f"{lesson} could not be executed: its kernel died."


def test_a_lesson_with_an_error_is_named_and_its_outputs_are_not_kept(course, tmp_path_factory):
    lesson = course / "course" / "01_nodes" / "lesson.ipynb"
    lesson.write_text(notebook(nbformat.v4.new_code_cell("1 / 0")))
    pages = tmp_path_factory.mktemp("pages")
    with pytest.raises(CommandFailed) as raised:
        make_site.write_pages(course, pages, pages / "kept", [], print)
    problem = "cell cell-0: ZeroDivisionError: division by zero"
    assert str(raised.value) == f"{lesson} could not be executed: {problem}"
    assert not (pages / "kept").exists()


def test_without_sphinx_the_command_says_what_installs_it(course, monkeypatch, capsys):
    monkeypatch.chdir(course)
    assert make_site.main(["--sphinx", "no/sphinx-build", "--lesson", "none"]) == 1
    assert capsys.readouterr().err == (
        "no/sphinx-build can't be run (No such file or directory): `make site` installs it\n"
    )


def test_what_sphinx_complains_about_is_shown(tmp_path):
    program = tmp_path / "sphinx-build"
    program.write_text("#!/bin/sh\necho no theme >&2\nexit 2\n")
    program.chmod(0o755)
    with pytest.raises(CommandFailed) as raised:
        make_site.build(program, tmp_path, tmp_path)
    assert str(raised.value) == "sphinx-build failed:\nno theme"


def write_lesson(course: Path, source: str, text: str = "# A title") -> None:
    cells = nbformat.v4.new_markdown_cell(text), nbformat.v4.new_code_cell(source)
    (course / "course" / "01_nodes" / "lesson.ipynb").write_text(notebook(*cells))


def test_a_page_is_executed_again_if_what_it_uses_has_changed(course, tmp_path_factory, monkeypatch):
    """The lesson doesn't use grader."""
    monkeypatch.setattr(site_pages, "COURSE", course)
    for name in ("sim/run.py", "grader/score.py", "course/01_nodes/goal.py", "requirements.lock"):
        (course / name).parent.mkdir(exist_ok=True)
        (course / name).touch()
    pages = tmp_path_factory.mktemp("pages")

    def executed() -> bool:
        lines = []
        site_pages._package_digest.cache_clear()
        make_site.write_pages(course, pages, pages / "kept", [], lines.append)
        return lines == ["course/01_nodes/lesson.ipynb"]

    write_lesson(course, "print(0)")
    assert executed() and not executed()
    for name in ("sim/run.py", "course/01_nodes/goal.py", "grader/score.py"):
        (course / name).write_text("LIMIT = 2\n")
        assert executed() == (name != "grader/score.py"), name
    write_lesson(course, "print(0)", text="# Another title")
    (course / "course" / "01_nodes" / "goal.svg").write_text("<svg/>\n")
    assert not executed()
    title, cell = json.loads((pages / "course" / "01_nodes" / "lesson.ipynb").read_text())["cells"]
    assert (title["source"], cell["outputs"][0]["text"]) == (["# Another title"], ["0\n"])
    write_lesson(course, "print(1)")
    assert executed()


@pytest.mark.parametrize(
    ("slider", "most", "expected"),
    [
        pytest.param(IntSlider(10, min=1, max=12), 12, [*range(1, 13)], id="all values"),
        pytest.param(FloatSlider(1.0, min=0.2, max=2.0, step=0.1), 5, [0.5, 1.0, 1.5, 2.0], id="its start"),
        pytest.param(FloatSlider(11.0, min=0.0, max=40.0), 5, [1.0, 11.0, 21.0, 31.0], id="a long one"),
    ],
)
def test_recorded_values_are_evenly_spaced_with_the_start(slider, most, expected):
    assert sampled(slider, most) == expected


def test_each_of_several_sliders_moves_alone(monkeypatch):
    def area(width, height):
        print(f"area {width * height}")

    pages = []
    monkeypatch.setattr(site_sliders, "display", pages.append)
    recorded(area, width=IntSlider(2, min=1, max=3), height=IntSlider(4, min=4, max=5))
    page = pages[0].data
    assert [f"area {size}" in page for size in (8, 4, 12, 10)] == [True] * 4
    assert "area 5" not in page and page.count("<template>") == 4
    assert "Recorded for 4 values. In the course, each value runs your program again." in page
    assert "Here one slider moves at a time: the others go back to their start." in page
