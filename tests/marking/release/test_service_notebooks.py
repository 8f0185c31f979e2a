"""Notebooks for services such as Colab."""

import json
import re
import shutil
from pathlib import Path, PurePosixPath

import pytest

from grader.marking.release import service_notebooks
from grader.marking.release.service_notebooks import (
    PublishedRelease,
    published,
    readme_with_link,
    service_notebook,
)
from tests.tooling.test_docs import ROOT

RELEASE = PublishedRelease("https://github.com/someone/ros2", "https://example.org/a.whl https://example.org/b.whl")
COLAB = "https://colab.research.google.com/github/someone/ros2/blob/notebooks"
PICTURE = '<svg xmlns="http://www.w3.org/2000/svg"/>'


@pytest.fixture
def course(tmp_path) -> Path:
    """A course with one lesson."""
    folder = tmp_path / "course" / "01_nodes"
    folder.mkdir(parents=True)
    (folder / "goal.svg").write_text(PICTURE)
    (folder / "more.ipynb").touch()
    (folder.parent / "glossary.md").touch()
    text = (
        "# Lesson\n![goal](goal.svg) [more](more.ipynb#part), [words](../glossary.md), "
        "[ROS](https://docs.ros.org) [here](#here) [gone](gone.md)"
    )
    cells = [
        {"cell_type": "markdown", "id": "title", "metadata": {}, "source": text},
        {"cell_type": "code", "id": "links", "metadata": {}, "source": "a[0](goal.svg)", "outputs": []},
    ]
    notebook = {"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}
    (folder / "lesson.ipynb").write_text(json.dumps(notebook))
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    return tmp_path


def publish(course: Path, address: str) -> None:
    """Let pyproject.toml name this address."""
    settings = course / "pyproject.toml"
    text = settings.read_text()
    settings.write_text(re.sub(r'^release = ".*"$', f'release = "{address}"', text, flags=re.M))


def cells(course: Path) -> list[tuple[str, str]]:
    """The ids and texts of the lesson's cells, as a service gets them."""
    name = "course/01_nodes/lesson.ipynb"
    notebook = json.loads(service_notebook(course / name, PurePosixPath(name), RELEASE))
    return [(cell["id"], "".join(cell["source"])) for cell in notebook["cells"]]


def test_the_first_cell_installs_the_course_where_it_is_missing(course):
    (_, notice), (name, code), *_ = cells(course)
    assert name == "service-install"
    assert "    %pip install --quiet https://example.org/a.whl https://example.org/b.whl\n" in code
    assert code.endswith('enter("course/01_nodes")')
    for absent in ("terminals", "colcon", "Validate", "`ros2-course lab`"):
        assert absent in notice


def test_the_first_cell_does_nothing_where_the_course_is_installed(course, monkeypatch):
    """As Python: that `%pip` runs only under its `if`."""
    from IPython.core.inputtransformer2 import TransformerManager

    (_, (_, code), *_) = cells(course)
    python = TransformerManager().transform_cell(code)
    monkeypatch.chdir(course / "course" / "01_nodes")
    before = sorted(course.rglob("*"))
    exec(python, {"get_ipython": lambda: pytest.fail("%pip ran")})
    assert Path.cwd() == course / "course" / "01_nodes" and sorted(course.rglob("*")) == before


def test_pictures_are_in_the_notebook_and_links_lead_to_the_services_pages(course):
    _, _, (_, title), (_, code) = cells(course)
    assert "![goal](data:image/svg+xml;base64,PHN2Zy" in title
    assert f"[more]({COLAB}/course/01_nodes/more.ipynb#part)" in title
    assert "[words](https://github.com/someone/ros2/blob/notebooks/course/glossary.md)" in title
    assert title.endswith("[ROS](https://docs.ros.org) [here](#here) [gone](gone.md)")
    assert code == "a[0](goal.svg)"


def test_a_service_gets_every_notebook_but_the_start_page_and_every_file_beside_them():
    found = service_notebooks.service_notebooks(ROOT, RELEASE)
    assert "course/start.ipynb" not in found
    assert {"course/00_robot/lesson.ipynb", "course/00_robot/goal.py"} <= set(found)
    assert b"](goal.svg)" not in b"".join(found.values())
    assert b"(../" not in found["exercises/01_nodes/nodes.ipynb"]


def test_the_release_is_that_of_pyproject(course):
    publish(course, "https://github.com/someone/ros2/")
    assert published(course) == PublishedRelease("https://github.com/someone/ros2")
    publish(course, "")
    assert published(course) is None


def test_an_address_that_colab_cannot_open_is_refused():
    with pytest.raises(ValueError) as error:
        PublishedRelease("https://gitlab.com/a/b")
    assert str(error.value) == (
        "`release` in pyproject.toml is not a repository on GitHub, such as "
        "https://github.com/OWNER/NAME: https://gitlab.com/a/b"
    )


def test_a_page_of_the_site_has_the_link_if_there_is_a_release(course):
    page = course / "course" / "01_nodes" / "lesson.ipynb"
    name, before = PurePosixPath("course/01_nodes/lesson.ipynb"), page.read_bytes()
    service_notebooks.add_service_link(page, name, None)
    assert page.read_bytes() == before
    service_notebooks.add_service_link(page, name, RELEASE)
    title = json.loads(page.read_text())["cells"][0]["source"]
    assert title.startswith("# Lesson\n") and title.endswith(f"\n\n[Open in Colab]({COLAB}/{name})")


def test_the_readme_has_the_link_if_there_is_a_release():
    text = "a\n<!-- service -->old<!-- /service -->\nb\n"
    assert readme_with_link(text, None) == "a\n<!-- service --><!-- /service -->\nb\n"
    link = f"[Open lesson 0 in Colab]({COLAB}/course/00_robot/lesson.ipynb): that needs no installation."
    assert link in readme_with_link(text, RELEASE)


def test_the_courses_readme_says_what_pyproject_says():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert "<!-- service -->" in text and readme_with_link(text, published(ROOT)) == text


def test_the_command_writes_the_readme(course, monkeypatch, capsys):
    monkeypatch.chdir(course)
    readme = course / "README.md"
    readme.write_text("<!-- service -->old<!-- /service -->\n")
    assert service_notebooks.main([]) == 0
    assert readme.read_text() == "<!-- service --><!-- /service -->\n"
    publish(course, "nowhere")
    assert service_notebooks.main([]) == 1
    assert capsys.readouterr().err.startswith("`release` in pyproject.toml is not a repository on GitHub")
