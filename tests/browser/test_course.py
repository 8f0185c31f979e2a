"""The course's own notebooks in JupyterLab, as a student uses them."""

import re

import pytest

from tests.browser.lab import ROOT

pytestmark = pytest.mark.browser


def some(folder):
    """Other tests run all notebooks in a kernel; what Lab adds, one shows, and soak tests show more."""
    chosen = sorted(str(path.relative_to(folder)) for path in folder.glob("*/*.ipynb"))[::3]
    return [chosen[0], *(pytest.param(path, marks=pytest.mark.soak) for path in chosen[1:])]


LESSONS, ASSIGNMENTS = some(ROOT / "course"), some(ROOT / "exercises")
# Text of stderr, and of errors, that a reader would see as red.
RED = """() => [...window.notebook().content.model.cells].flatMap(cell =>
    cell.type !== 'code' ? [] : cell.outputs.toJSON().filter(output =>
        output.output_type === 'error' || output.name === 'stderr').map(output =>
            output.evalue || output.text))"""


@pytest.mark.parametrize("notebook", LESSONS)
def test_a_lesson_runs_from_top_to_bottom_without_red(open_lab, notebook):
    with open_lab(f"course/{notebook}") as lab:
        lab.run_all()
        assert lab.page.evaluate(RED) == []
        lab.screenshot("lesson-" + notebook.split("/")[0])


@pytest.mark.parametrize("notebook", ASSIGNMENTS)
def test_an_assignment_that_is_not_started_runs_without_red_and_gives_no_points(open_lab, notebook):
    with open_lab(f"exercises/{notebook}") as lab:
        lab.run_all()
        assert lab.page.evaluate(RED) == []
        text = lab.output()
        assert text.count("This exercise is not started yet") == text.count(": 0 of ") > 0
        lab.screenshot("starter-" + notebook.split("/")[0])


@pytest.mark.parametrize("notebook", ASSIGNMENTS)
def test_validate_accepts_the_solution(open_lab, notebook):
    with open_lab(f"solved/{notebook}") as lab:
        rows = lab.validate()
    points, most = re.fullmatch(r"Total \| (\d+) of (\d+) \| ", rows[-1]).groups()
    assert points == most
    assert all(row.endswith(" | ✔") for row in rows[:-1])


@pytest.mark.parametrize("notebook", ASSIGNMENTS[:1])
def test_validate_gives_a_starter_no_points(open_lab, notebook):
    with open_lab(f"exercises/{notebook}") as lab:
        rows = lab.validate()
    assert len(rows) > 5 and rows[-1] == "Total | 0 of 100 | "
