import re

import pytest

from tests.browser.lab import SHOWN, START, write_notebook

pytestmark = pytest.mark.browser


def test_lab_starts_with_the_start_page_and_leads_on_and_back(lab, students_folder):
    before = (students_folder / "course/start.ipynb").read_bytes()
    lab.open()
    start = lab.page.locator(START)
    start.get_by_text("Your points so far: 0 of").wait_for()
    assert start.locator("h2").all_inner_texts()[:4] == ["Talk", "See", "Move", "Whole robots"]
    assert start.locator(".card").count() == 17 and start.locator(".jp-Cell").count() == 0
    assert lab.page.request.get(f"{lab.address}/api/kernels").json() == []
    lab.screenshot("start")
    lab.page.keyboard.press("Tab")  # in the order of the page: the two links of its first lines, then Next
    lab.page.keyboard.press("Tab")
    lab.page.keyboard.press("Tab")
    assert lab.page.evaluate("document.activeElement.className") == "next"
    lab.page.keyboard.press("Enter")
    tab = lab.page.locator(".lm-TabBar-tabLabel")
    tab.get_by_text("0 Robot: lesson", exact=True).wait_for()
    lab.wait_for_kernel()
    way(lab, "Next").click()
    tab.get_by_text("1 Nodes: lesson", exact=True).wait_for()
    lab.wait_for_kernel()
    way(lab, "Next").click()
    tab.get_by_text("1 Nodes: exercises", exact=True).wait_for()
    lab.wait_for_kernel()
    way(lab, "Course").click()
    start.get_by_role("link", name="2a Topics").click()
    tab.get_by_text("2 Topics: lesson", exact=True).wait_for()
    assert (students_folder / "course/start.ipynb").read_bytes() == before


def test_the_start_page_shows_what_was_run_since(lab, students_folder):
    lesson = students_folder / "course/01_nodes/lesson.ipynb"
    before = lesson.read_bytes()
    lab.open()
    ring = lab.page.locator(START).locator(".card", has_text="1 Nodes").get_by_role("img")
    lab.page.locator(START).get_by_role("link", name="1 Nodes").click()
    lab.wait_for_kernel()
    lab.run_cell(1)
    way(lab, "Course").click()
    lab.wait("() => document.querySelector('[aria-label^=\"1 of \"]')")
    assert ring.get_attribute("aria-label").startswith("1 of ")
    lesson.write_bytes(before)


def test_the_start_page_loads_nothing_and_names_what_is_missing(lab, students_folder):
    page = lab.page.request.get(f"{lab.address}/ros2-course/start").text()
    addresses = re.findall(r'(?:src|href)="(\w+:[^"]{1,20})', page)
    assert {address.split(",")[0] for address in addresses} == {"data:image/svg+xml"}
    (students_folder / "exercises").rename(students_folder / "away")
    try:
        answer = lab.page.request.get(f"{lab.address}/ros2-course/start")
    finally:
        (students_folder / "away").rename(students_folder / "exercises")
    assert answer.status == 404 and "expected a folder with course/ and exercises/ above it" in answer.text()


def way(lab, name):
    """A button of the notebook that shows."""
    bar = lab.page.locator(f"{SHOWN} .jp-Toolbar")
    return bar.get_by_role("button", name=name)


def test_the_first_press_on_run_works_before_the_kernel_is_there(lab, students_folder):
    write_notebook(students_folder / "cells/first.ipynb", "print(40 + 2)")
    lab.page.goto(f"{lab.address}/lab/workspaces/first/tree/cells/first.ipynb")
    lab.page.locator(f"{SHOWN} .jp-Cell .cm-content").first.click()
    lab.page.keyboard.press("Shift+Enter")
    lab.page.locator(".jp-OutputArea-output", has_text="42").wait_for()
    assert lab.page.locator(".jp-Dialog").count() == 0


def test_the_instructors_panels_are_hidden(open_lab):
    with open_lab("tiny/wrong.ipynb") as lab:
        assert lab.page.locator(".validate-button").is_visible()
        panels = ("formgrader", "formgrader-local", "create-assignment", "assignment-list", "course-list")
        assert [name for name in panels if lab.has_command(f"nbgrader:open-{name}")] == []
        assert lab.page.locator(".lm-MenuBar-itemLabel", has_text="Nbgrader").count() == 0
        assert lab.page.request.get(f"{lab.address}/formgrader").status == 404


def test_a_notebook_runs(open_lab):
    with open_lab("tiny/right.ipynb") as lab:
        lab.run_all()
        assert "3.0" in lab.output()


@pytest.mark.parametrize(
    ("notebook", "points", "total"),
    [("right", [2, 3, 1], 6), ("half_right", [2, 3, 0], 5), ("wrong", [0, 0, 0], 0)],
)
def test_validate_shows_the_points_of_each_check_and_their_sum(open_lab, notebook, points, total):
    with open_lab(f"tiny/{notebook}.ipynb") as lab:
        count = "window.notebook().content.model.cells.get(0).executionCount"
        before = lab.page.evaluate(count)
        *rows, last = lab.validate()
        assert [row.split(" | ")[1] for row in rows] == [
            f"{each} of {most}" for each, most in zip(points, (2, 3, 1), strict=True)
        ]
        assert last == f"Total | {total} of 6 | "
        assert lab.page.evaluate(count) == before
