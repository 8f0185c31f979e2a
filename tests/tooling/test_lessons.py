from pathlib import Path

import pytest

from tests.exercises.score_tables import notebook_run

ROOT = Path(__file__).parents[2]
WIDGET = "application/vnd.jupyter.widget-view+json"
LESSONS = sorted(ROOT.glob("course/*/*.ipynb"))


@pytest.mark.parametrize("lesson", [path.parent.name for path in LESSONS])
def test_a_lesson_runs_from_top_to_bottom(lesson):
    outputs = [output for cell in notebook_run("course", lesson).cells for output in cell.get("outputs", ())]
    assert outputs, "a lesson shows something"
    assert [output.evalue for output in outputs if output.output_type == "error"] == []
    assert not any(WIDGET in output.get("data", {}) for output in outputs), "a picture that nobody ends"


def test_every_assignment_has_a_lesson():
    assignments = {path.parent.name for path in ROOT.glob("solutions/*/*.ipynb")}
    assert {path.parent.name for path in LESSONS} == {"00_robot", *assignments}
