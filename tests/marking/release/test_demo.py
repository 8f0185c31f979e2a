import re
from pathlib import Path

import nbformat
import pytest
from nbgrader.apps import NbGrader
from nbgrader.validator import Validator
from traitlets.config import Config

from grader.marking.errors import CommandFailed
from grader.marking.release.demo import SampleMark, main, mark_samples, table
from grader.marking.release.make_exercises import copy_of_course
from grader.marking.release.nbgrader_command import assignments, nbgrader
from grader.marking.release.samples import SHARES
from grader.marking.secret import ACCEPTED, WITHOUT_SANDBOX
from tests.marking.tiny import ROOT, course, grade, tiny
from tests.patience import PATIENCE

STEPS: list[str] = []
TABLE = "<table><caption>a table</caption></table>"
SECRET = "import os\nprint('A secret of', len(os.environ.get('COURSE_SECRET', '')))"
SHOW = f"from IPython.display import HTML, display\ndisplay(HTML('{TABLE}<script>steal()</script>'))"


@pytest.fixture(scope="module")
def marked_course(tmp_path_factory) -> tuple[Path, dict[str, SampleMark]]:
    """The samples of a tiny course, marked by nbgrader with a secret.

    Its notebook says how long that is, shows a table and has scripts in it.
    """
    folder = tiny(
        tmp_path_factory.mktemp("class"),
        nbformat.v4.new_code_cell(SECRET, id="secret"),
        nbformat.v4.new_code_cell(SHOW, id="show"),
        nbformat.v4.new_markdown_cell("A *word* <script>steal()</script>", id="words"),
    )
    (folder / ".secret").touch(mode=0o600)
    (folder / ".secret").write_text("d1ce")
    return folder, {marked.student: marked for marked in mark_samples(folder, "01_tiny", STEPS.append)}


def names(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


def configuration(monkeypatch, folder: Path) -> Config:
    """The configuration as JupyterLab's Validate button reads it, in the folder where the server runs."""
    monkeypatch.chdir(folder)
    app = NbGrader()
    app.load_config_file()
    return app.config


def earned(marked: SampleMark) -> list[float]:
    return [points for points, _ in marked.points.values()]


def text(page: Path) -> str:
    return re.sub(r"<[^>]+>", "", page.read_text())


def test_marks_are_full_for_right_part_for_half_right_and_none_for_the_starter(marked_course):
    assert {student: earned(marked) for student, marked in marked_course[1].items()} == {
        "right": [2, 3, 1], "half_right": [2, 3, 0], "wrong": [0, 0, 0],
    }


def test_each_step_is_reported(marked_course):
    assert STEPS == [
        "1 of 1: exercises/01_tiny",
        "Running the notebooks of right, half_right, wrong ...",
        "Writing their pages of feedback ...",
    ]


def test_what_a_test_cell_writes_to_stderr_costs_nothing_and_shows_in_the_feedback(marked_course):
    right = marked_course[1]["right"]
    assert right.points["test_warn"] == (1, 1)
    assert "WARNING:root:from Python" in text(right.feedback)
    assert "from C" in text(right.feedback)


def test_feedback_shows_a_score_table_and_runs_no_script(marked_course):
    page = marked_course[1]["right"].feedback.read_text()
    assert TABLE in page
    assert "<p>A <em>word</em> </p>" in page
    assert "steal()</script>" not in page


def test_everything_about_a_class_lies_in_the_ignored_folder(marked_course):
    folder, _ = marked_course
    assert names(folder) == {".secret", "class", "exercises", "nbgrader_config.py", "solutions"}
    assert names(folder / "class") == {"autograded", "exchange", "feedback", "gradebook.db", "submitted"}
    assert "/class/\n" in (ROOT / ".gitignore").read_text()


def test_the_kernels_that_mark_get_the_secret_and_no_file_of_students_does(marked_course):
    folder, marks = marked_course
    assert {"A secret of 64\n" in text(marked.feedback) for marked in marks.values()} == {True}
    assert "d1ce" not in "".join(path.read_text() for path in (folder / "exercises").rglob("*.*"))


def test_the_command_stops_on_a_secret_that_others_may_read(marked_course):
    folder, _ = marked_course
    (folder / ".secret").chmod(0o640)
    with pytest.raises(CommandFailed, match=r"run `chmod 600 \.secret`, then mark again\.$"):
        nbgrader(folder, "autograde", "01_tiny", "--force", **{ACCEPTED: "yes"})
    (folder / ".secret").chmod(0o600)


def test_plain_autograde_refuses_before_it_removes_anything_and_names_the_way(marked_course):
    folder, _ = marked_course
    page = folder / "class" / "autograded" / "right" / "01_tiny" / "tiny.ipynb"
    before = page.read_bytes()
    with pytest.raises(CommandFailed) as failed:
        nbgrader(folder, "autograde", "01_tiny", "--force")
    assert str(failed.value).splitlines()[1:] == [f"    {WITHOUT_SANDBOX}"]
    assert page.read_bytes() == before


@pytest.mark.parametrize(("student", "failing"), [("right", 0), ("half_right", 1), ("wrong", 3)])
def test_validate_agrees_with_the_marks(marked_course, monkeypatch, student, failing):
    folder, _ = marked_course
    notebook = folder / "class" / "submitted" / student / "01_tiny" / "tiny.ipynb"
    result = Validator(config=configuration(monkeypatch, folder)).validate(str(notebook))
    assert len(result.get("failed", [])) == failing


def test_validate_waits_less_than_marking(tmp_path, monkeypatch):
    folder = course(tmp_path, grade("test_loop", 1, "while True:\n    pass"))
    config = configuration(monkeypatch, folder)
    assert (config.Execute.timeout, config.Validator.Execute.timeout) == (60, 30)
    config.Validator.Execute.timeout = 2
    result = Validator(config=config).validate(str(folder / "solutions" / "01_tiny" / "tiny.ipynb"))
    assert "No reply from kernel before timeout" in result["failed"][0]["raw_error"]


def test_validate_names_an_answer_cell_that_it_stopped(tmp_path, monkeypatch, capsys):
    answer = nbformat.v4.new_code_cell(f"import time\ntime.sleep({PATIENCE})\nBattery = 1", id="answer")
    folder = course(tmp_path, answer, grade("test_battery", 1, "assert Battery"))
    other = course(tmp_path / "other", grade("test_battery", 1, "assert Battery"))
    config = configuration(monkeypatch, folder)
    config.Validator.Execute.timeout_func = lambda cell: 1 if "sleep" in cell.source else PATIENCE
    notebook = Path("solutions", "01_tiny", "tiny.ipynb")
    [failed] = Validator(config=config).validate(str(folder / notebook))["failed"]
    assert failed["raw_error"].startswith(
        "Validate stopped a cell that ran longer than its time limit. It begins with:\n    import time\n"
        "What that cell defines can be missing below it. Marking allows more time.\n"
    )
    assert failed["raw_error"].endswith(": name 'Battery' is not defined")
    [failed] = Validator(config=config).validate(str(other / notebook))["failed"]
    assert "Validate" not in failed["raw_error"]


def test_the_table_shows_points_per_exercise_and_the_pages():
    marks = [
        SampleMark("right", {"a": (2, 2), "long": (1.5, 1.5)}, Path("r.html")),
        SampleMark("wrong", {"a": (0, 2), "long": (0.5, 1.5)}, Path("w.html")),
    ]
    assert table(marks) == (
        "            right       wrong          of\n"
        "a               2           0           2\n"
        "long          1.5         0.5         1.5\n"
        "total         3.5         0.5         3.5\n"
        "\n"
        "feedback for right: r.html\n"
        "feedback for wrong: w.html"
    )


def test_the_demo_outside_a_course_says_where_to_go(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit):
        main([])
    expected = f"expected solutions/*/*.ipynb in {tmp_path}, saw none: go to the course's folder\n"
    assert capsys.readouterr().err.endswith(expected)


@pytest.mark.soak
@pytest.mark.parametrize("assignment", assignments(ROOT)[:1])  # tests/exercises runs the others' notebooks
def test_the_courses_own_solutions_earn_everything_and_its_starters_nothing(assignment, tmp_path):
    marks = {marked.student: marked for marked in mark_samples(copy_of_course(ROOT, tmp_path), assignment)}
    assert list(marks) == list(SHARES)
    right, half, wrong = (earned(marked) for marked in marks.values())
    assert right == [possible for _, possible in marks["right"].points.values()]
    assert wrong == [0] * len(right)
    assert 0 < sum(half) < sum(right)
