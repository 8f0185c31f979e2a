"""What holds for every page of the bridge, the chapter after the lessons."""

import functools
import json
import re
from pathlib import Path

import pytest

from grader.marking.release.run_notebooks import execute

ROOT = Path(__file__).parents[2]
BRIDGE = ROOT / "course" / "bridge"
PAGES = sorted(path.stem for path in BRIDGE.glob("*.ipynb"))
# The others are run by `make solutions`, for each change that is proposed.
EVERY_DAY = "01_ros1"
RUNS = [name if name == EVERY_DAY else pytest.param(name, marks=pytest.mark.soak) for name in PAGES]


def cells(page):
    """Each cell's id, with its source."""
    notebook = json.loads((BRIDGE / f"{page}.ipynb").read_text("utf-8"))
    return {cell["id"]: "".join(cell["source"]) for cell in notebook["cells"]}


@functools.cache
def outputs(page):
    notebook, stopped = execute(BRIDGE / f"{page}.ipynb")
    assert stopped == ()
    return [output for cell in notebook.cells for output in cell.get("outputs", ())]


@pytest.mark.parametrize("page", RUNS)
def test_a_page_runs_from_top_to_bottom(page):
    assert outputs(page), "a page shows something"
    assert [output.evalue for output in outputs(page) if output.output_type == "error"] == []
    assert [output.text for output in outputs(page) if output.get("name") == "stderr"] == []


@pytest.mark.parametrize("page", PAGES)
def test_a_page_says_what_it_takes_and_where_to_read_on(page):
    texts = cells(page)
    assert "**Time:**" in texts["title"] and "(../glossary.md)" in texts["title"]
    assert "**Before you begin:**" in texts["title"]
    assert "From lesson " in texts["check"], "a question on a lesson"
    assert "**Read on" in texts["summary"] and "](https://" in texts["summary"]


@pytest.mark.parametrize("page", PAGES)
def test_a_page_says_what_was_not_run(page):
    assert "**Not run here:**" in "".join(cells(page).values())


@pytest.mark.parametrize("page", PAGES)
def test_a_page_is_short(page):
    assert 8 <= len(cells(page)) <= 30


@pytest.mark.parametrize("page", PAGES)
def test_every_link_of_a_page_leads_somewhere(page):
    links = re.findall(r"\]\((?!https://)([^)#]+)\)", "\n".join(cells(page).values()))
    assert [link for link in links if not (BRIDGE / link).exists()] == []


def test_the_last_page_is_the_only_one_without_a_next_one():
    summaries = [cells(page)["summary"] for page in PAGES]
    following = [re.search(r"\*\*Next:\*\* .*?\((\w+)\.ipynb\)", summary, re.S) for summary in summaries]
    assert [found and found[1] for found in following] == [*PAGES[1:], None]
