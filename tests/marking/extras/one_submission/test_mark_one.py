"""`python -m grader mark-one` says what `python -m grader mark` says, and writes it in a published form."""
import json
import shutil
from pathlib import Path

import jsonschema
import pytest

from grader.__main__ import main
from grader.marking.command.task_reader import TaskReader
from grader.marking.extras.one_submission import judge_one
from grader.marking.extras.one_submission.judge_one import Judged, JudgeSettings
from grader.marking.extras.one_submission.report import SCHEMA, LateRule, as_text, report
from grader.marking.gradebook.course import Course, write_timestamp
from grader.marking.journal import Journal
from grader.marking.lateness import Lateness, late_penalty, parse_local
from grader.marking.result import CellResult, NotebookResult, Result
from grader.marking.submission.assignment_release import Release, load_release
from tests.marking.hostile.corpus import ASSIGNMENT, SECRET, course, limits_of, mark, submit
from tests.marking.hostile.test_corpus import EVERYBODY

LATE = "honest_half"
DUE, HANDED_IN = "2026-03-01 12:00+00:00", "2026-03-02 18:00+00:00"
COMPARED = [LATE, "patched_exercise", "broken_json", "missing_notebook"]


def schema() -> dict:
    return json.loads(SCHEMA.read_text())


@pytest.fixture(scope="module")
def marked(tmp_path_factory) -> Path:
    """A class that `mark` has marked: one student is late, at 10 % a day."""
    folder = course(tmp_path_factory.mktemp("class"))
    with open(folder / "nbgrader_config.py", "a") as file:
        file.write("c.LateDays.percent_per_day = 10\n")
    submit(folder, COMPARED)
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        write_timestamp(Course(folder).submitted(LATE, ASSIGNMENT), parse_local(HANDED_IN))
        assert main(["due", ASSIGNMENT, DUE]) == 0
        assert main(["mark", ASSIGNMENT]) == 0
    return folder


def by_mark(folder: Path, student: str) -> Result:
    """What `mark` stored."""
    return Journal(Course(folder).journal(ASSIGNMENT)).last(student).result


@pytest.mark.parametrize("student", COMPARED)
def test_it_says_what_mark_says_to_the_word(marked, student, tmp_path, monkeypatch):
    monkeypatch.chdir(marked)
    submission = Path("class", "submitted", student, ASSIGNMENT)
    out, pages = tmp_path / "results.json", tmp_path / "pages"
    times = ["--due", DUE, "--handed-in", HANDED_IN] if student == LATE else []
    words = [str(submission), "--assignment", ASSIGNMENT, "--student", student, "--no-self-check"]
    assert main(["mark-one", *words, "--out", str(out), "--page", str(pages), *times]) == 0
    found = json.loads(out.read_text())
    jsonschema.validate(found, schema())
    late = LateRule(Lateness(parse_local(DUE), parse_local(HANDED_IN)), 10.0) if times else None
    release = load_release(Path("exercises", ASSIGNMENT))
    expected = report(Judged(by_mark(marked, student), release, {}, "bubblewrap"), late)
    own = {"seconds": 0, "evidence": {}}
    assert found | own == expected | own
    folder = Course(marked).feedback(student, ASSIGNMENT)
    made = {page.name: page.read_text() for page in pages.iterdir()}
    assert made == {page.name: page.read_text() for page in folder.glob("*.html")}


def test_being_late_costs_what_it_costs_in_the_gradebook(marked):
    found = report(
        Judged(by_mark(marked, LATE), load_release(marked / "exercises" / ASSIGNMENT), {}, "bubblewrap"),
        LateRule(Lateness(parse_local(DUE), parse_local(HANDED_IN)), 10.0),
    )
    assert (found["points"], found["points_after_lateness"]) == (15.0, 12.0)
    assert found["late"] == {
        "due": "2026-03-01T12:00:00+00:00",
        "handed_in": "2026-03-02T18:00:00+00:00",
        "days": 1.25,
        "percent_per_day": 10.0,
        "penalty": 3.0,
    }
    assert late_penalty(15.0, 108_000, 10.0) == 3.0


def test_one_exercise_alone_gets_what_it_gets_with_the_others(marked, tmp_path, monkeypatch):
    monkeypatch.chdir(marked)
    notebook = tmp_path / "topics.ipynb"
    shutil.copy(Path("class", "submitted", LATE, ASSIGNMENT, "topics.ipynb"), notebook)
    out = tmp_path / "results.json"
    words = ["--assignment", ASSIGNMENT, "--exercise", "temperature", "--student", LATE, "--no-self-check"]
    assert main(["mark-one", str(notebook), *words, "--out", str(out)]) == 0
    found = json.loads(out.read_text())
    whole = report(Judged(by_mark(marked, LATE), load_release(Path("exercises", ASSIGNMENT)), {}, "none"))
    assert found["exercises"] == [each for each in whole["exercises"] if each["exercise"] == "temperature"]
    assert found["max_points"] == 15.0


@pytest.mark.soak
def test_of_the_whole_hostile_corpus_it_says_what_mark_says(tmp_path):
    folder = course(tmp_path)
    names = [name for name in submit(folder) if name in EVERYBODY]
    reader = TaskReader(load_release(folder / "exercises" / ASSIGNMENT), SECRET)
    by_class = mark(folder, names)
    own = {"seconds": 0, "evidence": {}}
    for name in names:
        settings = JudgeSettings(SECRET, self_check=False, time_limits=limits_of(name))
        task = reader.read(name, folder / "class" / "submitted" / name / ASSIGNMENT)
        with judge_one.open_pool(settings) as pool:
            judged = judge_one.judge_in(pool, task, SECRET)
        found = json.loads(as_text(report(judged)))
        jsonschema.validate(found, schema())
        expected = report(Judged(by_class[name], reader.release, {}, "bubblewrap"))
        assert found | own == json.loads(as_text(expected)) | own, name
        assert SECRET not in json.dumps(found)


def run(capsys, *words: object) -> tuple[int, str]:
    """The exit status and what is printed to stderr."""
    try:
        status = main(["mark-one", *map(str, words)])
    except SystemExit as end:
        status = int(end.code)
    return status, capsys.readouterr().err


@pytest.fixture
def released(tmp_path, monkeypatch) -> Path:
    """A folder with a released assignment and a submission, in which the test runs."""
    monkeypatch.chdir(course(tmp_path))
    submit(tmp_path, ["honest_half"])
    return Path("class", "submitted", "honest_half", ASSIGNMENT)


NAMED = ("--assignment", ASSIGNMENT, "--student", "ann")
WRONG = {
    "no assignment": ((), "expected SUBMISSION and --assignment NAME"),
    "unknown assignment": (
        ("--assignment", "77_none"),
        "expected an assignment in exercises/77_none, saw no notebook: run `make exercises` first",
    ),
    "no student": (("--assignment", ASSIGNMENT), "with a secret each student has other worlds: expected"
                   " --student NAME"),
    "a student who is a path": (
        ("--assignment", ASSIGNMENT, "--student", "../x"),
        "expected a name without `/` for --student, saw '../x'",
    ),
    "unknown exercise": (
        (*NAMED, "--exercise", "squares"),
        "02_small has no exercise 'squares': expected one of temperature, square",
    ),
    "half of the times": ((*NAMED, "--due", DUE), "expected --due TIME and --handed-in TIME together"),
    "no time": (
        (*NAMED, "--due", "soon", "--handed-in", DUE),
        "expected day and time such as 2026-12-01 18:00, saw 'soon'",
    ),
    "a receipt without an issuer": (
        (*NAMED, "--receipt", "r.json"), "expected --receipt FILE and --issuer TEXT together"
    ),
    "a page of one exercise": (
        (*NAMED, "--exercise", "square", "--page", "pages"),
        "--page and --receipt are for a whole assignment: leave out --exercise",
    ),
    "limits": ((*NAMED, "--seconds", "0"), "expected a number from 1 to 100000, saw '0'"),
    "percent": ((*NAMED, "--percent-per-day", "101"), "expected a number from 0 to 100, saw '101'"),
}  # fmt: skip


def test_a_wrong_command_line_has_status_2_and_leaves_no_file(released, capsys):
    for name, (words, why) in WRONG.items():
        Path("r.json").write_text("old")
        status, error = run(capsys, released, "--out", "r.json", *words)
        assert (name, status) == (name, 2)
        assert error.endswith(f"{why}\n"), name
    nothing = Path("none.ipynb")
    status, error = run(capsys, nothing, *NAMED)
    assert status == 2
    assert error.endswith("expected a submission, a folder or a notebook, saw no none.ipynb\n")


def test_what_could_not_be_judged_has_status_1_and_no_file(released, capsys, monkeypatch):
    monkeypatch.setenv("PATH", str(Path.cwd()))  # no bubblewrap there
    monkeypatch.setattr("os.geteuid", lambda: 1000)
    Path("r.json").write_text("of an earlier submission")
    status, error = run(capsys, released, *NAMED, "--out", "r.json")
    assert status == 1
    assert error.startswith("Not judged: Marking runs students' code in a sandbox made by bubblewrap, and")
    assert not Path("r.json").exists()


def test_the_schema_is_printed_and_is_one(capsys):
    assert main(["mark-one", "--schema"]) == 0
    printed = json.loads(capsys.readouterr().out)
    jsonschema.Draft202012Validator.check_schema(printed)
    assert printed == schema()


def long_result() -> Judged:
    """A result with long texts."""
    verdict = {
        "name": "check", "sentence": "It works.", "points": 2.0, "earned": 0.0, "status": "failed",
        "expected": "x" * 9000, "saw": "é" * 9000, "hint": "", "alarm": "",
    }  # fmt: skip
    cell = CellResult("cell", "exercise", 0.0, 2.0, [verdict] * 3)
    result = Result("ann", "a", "00", "marked", notebooks=[NotebookResult("n", {"cells": []}, [cell])])
    return Judged(result, Release("a", {}), {}, "bubblewrap")


def test_a_long_result_is_shortened_to_the_size_that_is_allowed():
    data = report(long_result())
    assert len(as_text(data).encode()) > 70_000
    short = as_text(data, 5000)
    assert len(short.encode()) <= 5000
    found = json.loads(short)
    jsonschema.validate(found, schema())
    assert found["exercises"][0]["checks"][0]["expected"] == "x" * 300 + " [...]"
    assert found["max_points"] == 2.0
