"""The web site: what it is built from, and what a browser finds in it."""
import json
import os
from pathlib import Path

import nbformat
import pytest
from playwright.sync_api import expect

from grader.marking.errors import CommandFailed
from grader.marking.release import make_site
from tests.browser.pictures import chromium
from tests.marking.tiny import ROOT
from tests.patience import PATIENCE

SPHINX = ROOT / ".venv-site" / "bin" / "sphinx-build"
REPLAY = """
from rclpy.node import Node
from sim import run
run(lambda: Node("still"), world="room", seconds=2).replay()
"""
MAP = """
from IPython.display import HTML
HTML('<a href="../course/01_nodes/lesson.ipynb">Lesson 1</a> <a href="https://a.org/b.ipynb">b</a>')
"""
LESSON = """# Lesson one

$$\\frac{1}{2}$$

A program that **waits** for [words](../glossary.md).

**Time:** about 90 minutes."""
TEXTS = {
    "course/glossary.md": "# Glossary\n\n| a | b | |\n|--|--|--:|\n| **program** | a file | 1 |\n",
    "course/real_robot.md": "# A real robot\n",
    "course/TUTOR.md": "# A tutor\n",
}


def notebook(*cells: nbformat.NotebookNode) -> str:
    for number, cell in enumerate(cells):
        cell.id = f"cell-{number}"
    return nbformat.writes(nbformat.v4.new_notebook(cells=list(cells)))


@pytest.fixture
def course(tmp_path: Path) -> Path:
    """A course with a start page, a lesson and a task."""
    code, text = nbformat.v4.new_code_cell, nbformat.v4.new_markdown_cell
    notebooks = {
        "course/start.ipynb": (text("# Start"), code("raise SystemExit('not executed')")),
        "course/01_nodes/lesson.ipynb": (text(LESSON), code(REPLAY), code(MAP)),
        "exercises/01_nodes/nodes.ipynb": (text("# Task one"), code("raise SystemExit('not executed')")),
    }
    for name, content in (TEXTS | {name: notebook(*cells) for name, cells in notebooks.items()}).items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(content)
    return tmp_path


def test_lessons_are_executed_and_tasks_are_not(course, tmp_path_factory):
    pages, lines = tmp_path_factory.mktemp("pages"), []
    make_site.write_pages(course, pages, [], lines.append)
    assert lines == ["course/01_nodes/lesson.ipynb"]
    names = "course/01_nodes/lesson.ipynb", "exercises/01_nodes/nodes.ipynb"
    (_, lesson, links), (_, task) = (json.loads((pages / name).read_text())["cells"] for name in names)
    assert "<script" in "".join(lesson["outputs"][0]["data"]["text/html"])
    assert task["outputs"] == [] and not (pages / "course" / "start.ipynb").exists()
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
    make_site.write_pages(course, pages, ["no_such_lesson"], print)
    lists = (pages / "index.md").read_text().split(":caption: ")[1:]
    entries = {name: [line for line in lines if "/" in line] for name, *lines in map(str.splitlines, lists)}
    assert entries["Lessons"] == ["course/01_nodes/lesson"]
    assert entries["Other systems"] == ["course/bridge/01_ros1"]


def test_one_lesson_is_executed_on_request(course, tmp_path_factory):
    lines = []
    make_site.write_pages(course, tmp_path_factory.mktemp("pages"), ["no_such_lesson"], lines.append)
    assert lines == []


def test_a_lesson_whose_kernel_dies_is_named(course, tmp_path_factory):
    lesson = course / "course" / "01_nodes" / "lesson.ipynb"
    lesson.write_text(notebook(nbformat.v4.new_code_cell("import os; os._exit(1)")))
    with pytest.raises(CommandFailed) as raised:
        make_site.write_pages(course, tmp_path_factory.mktemp("pages"), [], print)
    assert str(raised.value) == f"{lesson} could not be executed: its kernel died."


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


@pytest.mark.soak
@pytest.mark.browser
@pytest.mark.skipif(not os.access(SPHINX, os.X_OK), reason="`make site` has not installed Sphinx here")
def test_a_folder_without_a_server_has_replays_search_and_links(course, monkeypatch):
    monkeypatch.chdir(course)
    assert make_site.main(["--sphinx", str(SPHINX)]) == 0
    expect.set_options(timeout=1000 * PATIENCE)
    site, elsewhere = (course / "dist" / "site").as_uri(), []
    with chromium() as browser:
        page = browser.new_page()
        page.on("request", lambda request: elsewhere.append(request.url))
        page.goto(f"{site}/index.html")
        expect(page.locator(".home .ros2-view canvas").first).to_be_visible()
        assert "about 90 minutes" in page.locator(".home .parts").inner_text()
        assert page.locator("article").inner_text().count("points") == 1  # of the check that is shown
        page.click("article a:has-text('1 Lesson one')")
        expect(page.locator("h1")).to_contain_text("Lesson one")
        expect(page.locator(".ros2-replay .ros2-view")).to_be_visible()
        expect(page.locator("math mfrac")).to_have_count(1)
        page.goto(f"{site}/search.html?q=program")
        expect(page.locator("ul.search a").first).to_have_text("Lesson one")  # which explains it
        expect(page.locator("ul.search p.context").first).to_contain_text("A program that")
    assert [address for address in elsewhere if address.startswith("http")] == []
