"""Gradescope's leaderboard: each robot works in the same warehouses, and its results there are reported."""
import json
from dataclasses import replace
from pathlib import Path

import jsonschema
import pytest

from grader.__main__ import main
from grader.marking.errors import CourseError, SandboxMissing
from grader.marking.extras.league.contest import Contest, Game
from grader.marking.extras.league.standings import LeagueRow
from grader.marking.extras.platforms import gradescope, leaderboard, run
from grader.marking.extras.platforms.bundle import PlatformSettings, bundle
from grader.marking.extras.platforms.leaderboard import LeagueSettings, columns, columns_and_note
from grader.marking.submission.assignment_release import load_release
from tests.marking.extras.league.capstones import ASSIGNMENT, CRASHES, PROGRAMS, classroom, robot
from tests.marking.extras.platforms.test_bundle import REPORT, course  # noqa: F401
from tests.marking.extras.platforms.test_results import GRADESCOPE, METADATA
from tests.marking.tiny import ROOT

GAME = Game(3, 4, 1, 2, 61.0, 20.0, "ab", "", "")
SHORT = Contest("words", 2, 4)
COLUMNS = [
    {"name": "Orders delivered", "value": 6},
    {"name": "People touched", "value": 2, "order": "asc"},
    {"name": "Other contacts", "value": 4, "order": "asc"},
    {"name": "Seconds per order", "value": 20.3, "order": "asc"},
]


def test_the_columns_rank_robots_as_the_league_does():
    assert columns(LeagueRow("ann", "robin", (GAME, GAME))) == COLUMNS
    report = REPORT | {"points_after_lateness": 3.0}
    found = gradescope.results(report, leaderboard=COLUMNS)
    jsonschema.validate(found, GRADESCOPE)
    assert found["leaderboard"] == COLUMNS


def test_a_robot_that_delivers_nothing_has_no_time_and_one_that_did_not_run_has_no_row():
    idle = replace(GAME, delivered=0, waited=0.0)
    assert [each["name"] for each in columns(LeagueRow("ann", "robin", (idle,)))] == [
        "Orders delivered", "People touched", "Other contacts"
    ]  # fmt: skip
    assert columns(LeagueRow("ann", "robin", ())) == []


def test_the_warehouses_depend_on_the_secret_and_on_no_student():
    one, other = LeagueSettings(60, "the secret").contest, LeagueSettings(60, "another").contest
    assert one == LeagueSettings(60, "the secret").contest
    assert one.seed != other.seed
    assert (one.worlds, one.seconds, one.robots) == (10, 120.0, 1)
    assert "secret" not in one.seed + repr(LeagueSettings(60, "the secret"))
    assert LeagueSettings(60).contest == Contest()


@pytest.fixture
def short(monkeypatch) -> None:
    """Two warehouses of four seconds."""
    monkeypatch.setattr(LeagueSettings, "contest", SHORT)


@pytest.fixture
def robots(tmp_path) -> Path:
    """A class of three robots, of which one is none."""
    return classroom(tmp_path / "course", {"anna": robot(), "dora": CRASHES, "gus": PROGRAMS})


NOTES = {"anna": "", "dora": "Something went wrong in 2 of 2 warehouses, first in 1."}


@pytest.mark.parametrize("student", NOTES)
def test_a_real_robot_gets_its_row_in_the_sandbox(robots, short, student):
    submission, release = robots / "class/submitted" / student / ASSIGNMENT, robots / "exercises" / ASSIGNMENT
    found, note = columns_and_note(submission, release, LeagueSettings(60))
    assert note == NOTES[student]
    assert [each["name"] for each in found[:3]] == [each["name"] for each in COLUMNS[:3]]
    assert found[0]["value"] == 0  # no robot delivers in four seconds


def test_a_robot_without_a_row_keeps_its_mark_and_the_instructor_reads_why(robots, short, monkeypatch):
    release = robots / "exercises" / ASSIGNMENT
    gus = robots / "class/submitted/gus" / ASSIGNMENT
    nothing = [], "no entry: the robot's programs could not be run in any warehouse"
    assert columns_and_note(gus, release, LeagueSettings(60)) == nothing
    none = robots / "nothing.ipynb"
    assert columns_and_note(none, release, LeagueSettings(60)) == (
        [], f"no entry: expected a submission, a folder or a notebook, saw no {none}"
    )  # fmt: skip

    def no_pool(*_, **__):
        raise SandboxMissing("no sandbox here")

    monkeypatch.setattr(leaderboard, "Pool", no_pool)
    assert columns_and_note(gus, release, LeagueSettings(60)) == ([], "no entry: no sandbox here")


def judged(course: Path, monkeypatch) -> dict:  # noqa: F811
    """What Gradescope gets from an autograder with a league, whose points are already known."""
    root = course / "autograder"
    root.mkdir()
    (root / "submission_metadata.json").write_text(json.dumps(METADATA))
    monkeypatch.setattr(run, "_mark_one", lambda words: _write(Path(words[words.index("--out") + 1])))
    settings = PlatformSettings("13b_delivery", league=True)
    assert run.execute(run.run_gradescope(settings, root), settings) == 0
    return json.loads((root / "results" / "results.json").read_text())


def _write(path: Path) -> int:
    path.write_text(json.dumps(REPORT))
    return 0


def test_the_row_is_in_the_results(course, monkeypatch):  # noqa: F811
    got = []

    def play(*words):
        got.append(words)
        return COLUMNS, ""

    monkeypatch.setattr(leaderboard, "columns_and_note", play)
    assert judged(course, monkeypatch)["leaderboard"] == COLUMNS
    submission, release, how = got[0]
    assert (submission, release) == (course / "autograder/submission", course / "release/13b_delivery")
    assert how == LeagueSettings(480.0, "the secret of this class")


def test_without_a_row_the_results_are_whole_and_the_instructor_reads_why(course, monkeypatch, capsys):  # noqa: F811
    monkeypatch.setattr(leaderboard, "columns_and_note", lambda *_: ([], "no entry: it broke\x1b"))
    found = judged(course, monkeypatch)
    assert found["score"] == 3.0
    assert "leaderboard" not in found
    assert capsys.readouterr().out.splitlines()[0] == "Leaderboard: no entry: it broke ."


def test_a_bundle_with_a_league_has_its_code_and_others_have_not(course):  # noqa: F811
    folder = "course/grader/marking/extras/league/"
    needed = {f"{folder}{name}.py" for name in ("contest", "contest_procedure", "contest_run", "standings")}
    plain = bundle(course, PlatformSettings("02_topics"), "")
    assert not [name for name in plain if name.startswith(folder)]
    assert needed < set(bundle(course, PlatformSettings("13b_delivery", league=True), ""))


def test_an_assignment_without_a_whole_robot_has_no_league(course, capsys):  # noqa: F811
    assert main(["platform", "gradescope", "02_topics", "--league"]) == 1
    assert capsys.readouterr().err == (
        "No autograder: --league needs an assignment that ends with the exercise `deliver`, such as "
        "13b_delivery; leave it out for 02_topics.\n"
    )
    leaderboard.require_capstone(load_release(ROOT / "exercises" / "13b_delivery"))
    empty = replace(load_release(ROOT / "exercises" / "02_topics"), notebooks={})
    with pytest.raises(CourseError, match="leave it out for 02_topics"):
        leaderboard.require_capstone(empty)


def test_only_gradescope_has_a_leaderboard(course, capsys):  # noqa: F811
    with pytest.raises(SystemExit) as end:
        main(["platform", "prairielearn", "13b_delivery", "--league"])
    assert end.value.code == 2
    assert capsys.readouterr().err.endswith(
        "error: prairielearn has no leaderboard, which --league is for: leave it out\n"
    )
