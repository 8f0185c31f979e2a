"""The model answers earn everything when a class is marked, and none of their cells fails there."""

from collections.abc import Iterator

import pytest

from grader.marking.pool import Pool
from grader.marking.submission.assignment_release import load_release
from grader.marking.submission.submitted_files import read_folder
from grader.marking.task import MarkingTask
from tests.marking.tiny import ROOT

ASSIGNMENTS = sorted(path.name for path in (ROOT / "solutions").glob("[0-9]*"))
LONG = "05_sensing", "05b_guarding", "06b_navigating", "13b_delivery"  # half a minute each, or more


@pytest.fixture(scope="module")
def pool() -> Iterator[Pool]:
    with Pool(1, secret="a secret of this test") as made:
        yield made


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.soak] if name in LONG else []) for name in ASSIGNMENTS]
)
def test_a_model_answer_earns_everything_and_none_of_its_cells_fails(pool, name):
    release = load_release(ROOT / "exercises" / name)
    task = MarkingTask(name, release, read_folder(ROOT / "solutions" / name, release), "00")
    (result,) = pool.mark([task])
    cells = [cell for notebook in result.notebooks for cell in notebook.cells]
    assert [(cell.exercise, cell.points) for cell in cells] == [(cell.exercise, cell.max) for cell in cells]
    shown = [cell.get("outputs", ()) for notebook in result.notebooks for cell in notebook.notebook["cells"]]
    errors = [out["evalue"] for outputs in shown for out in outputs if out["output_type"] == "error"]
    assert errors == []
    assert (result.flags, bool(cells)) == ([], True)
