"""The course's own notebooks in JupyterLab, as a student uses them."""

import pytest

from tests.browser.lab import ROOT

pytestmark = pytest.mark.browser
# Other tests run every lesson, starter and solution in a kernel; what Lab adds, every third of them shows.
LESSONS = sorted(str(path.relative_to(ROOT)) for path in ROOT.glob("course/*/*.ipynb"))[::3]
ASSIGNMENTS = sorted(str(path.relative_to(ROOT / "exercises")) for path in ROOT.glob("exercises/*/*.ipynb"))
ASSIGNMENTS = ASSIGNMENTS[::3]
# Text of stderr, and of errors, that a reader would see as red.
RED = """() => [...window.jupyterapp.shell.currentWidget.content.model.cells].flatMap(cell =>
    cell.type !== 'code' ? [] : cell.outputs.toJSON().filter(output =>
        output.output_type === 'error' || output.name === 'stderr').map(output =>
            output.evalue || output.text))"""


@pytest.mark.parametrize("notebook", LESSONS)
def test_a_lesson_runs_from_top_to_bottom_without_red(lab, notebook):
    lab.open(notebook)
    lab.run_all()
    assert lab.page.evaluate(RED) == []
    lab.screenshot("lesson-" + notebook.split("/")[1])


@pytest.mark.parametrize("notebook", ASSIGNMENTS)
def test_an_assignment_that_is_not_started_runs_without_red_and_gives_no_points(lab, notebook):
    lab.open(f"exercises/{notebook}")
    lab.run_all()
    assert lab.page.evaluate(RED) == []
    text = lab.output()
    assert text.count("This exercise is not started yet") == text.count(": 0 of ") > 0
    lab.screenshot("starter-" + notebook.split("/")[0])


@pytest.mark.parametrize("notebook", ASSIGNMENTS)
def test_validate_accepts_the_solution(lab, notebook):
    lab.open(f"solved/{notebook}")
    assert "Success! Your notebook passes all the tests." in lab.validate()


@pytest.mark.parametrize("notebook", ASSIGNMENTS[:1])
def test_validate_names_every_cell_of_a_starter(lab, notebook):
    lab.open(f"exercises/{notebook}")
    tests = lab.page.evaluate("""() => [...window.jupyterapp.shell.currentWidget.content.model.cells].filter(
        cell => (cell.getMetadata('nbgrader') || {}).points).length""")
    assert lab.validate().count("The following cell failed:") == tests
