"""What is as it should be stays as it is, and nothing is said about it."""

import nbformat
import pytest

from grader.marking.release.samples import submission
from grader.marking.submission.assignment_release import load_release
from tests.marking.submission.damage import ASSIGNMENTS, ROOT, rebuilt_folder, same


@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("assignment", ASSIGNMENTS)
def test_an_honest_submission_is_run_as_it_is_and_nothing_is_reported(assignment, share, tmp_path):
    release = load_release(ROOT / "exercises" / assignment)
    for name, starter in release.notebooks.items():
        solution = nbformat.read(ROOT / "solutions" / assignment / f"{name}.ipynb", 4)
        nbformat.write(honest := submission(solution, starter, share), tmp_path / f"{name}.ipynb")
        rebuilt = rebuilt_folder(tmp_path, release)
        assert (rebuilt.repairs, rebuilt.flags, rebuilt.missing) == ([], [], {})
        assert same(rebuilt.notebooks[name].notebook, honest)
        expected = {0.0: {"untouched"}, 0.5: {"untouched", "answered"}, 1.0: {"answered"}}
        assert set(rebuilt.notebooks[name].answers.values()) == expected[share]


@pytest.mark.parametrize("assignment", ASSIGNMENTS)
def test_the_instructors_solution_as_a_submission_is_run_with_its_answers(assignment):
    release = load_release(ROOT / "exercises" / assignment)
    rebuilt = rebuilt_folder(ROOT / "solutions" / assignment, release)
    message = "Handed in alongside the notebook and not used: `answers.md`."
    assert (rebuilt.repairs, rebuilt.flags) == ([message], [])
    for name, starter in release.notebooks.items():
        solution = nbformat.read(ROOT / "solutions" / assignment / f"{name}.ipynb", 4)
        assert same(rebuilt.notebooks[name].notebook, submission(solution, starter, 1.0))
