"""The whole command with real robots, without the sandbox, and what keeps it from working."""

import contextlib
import json
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from itertools import islice
from pathlib import Path

import pytest

from grader.marking.extras.league.cli import main
from grader.marking.extras.league.contest import Contest
from grader.marking.extras.league.league_pages import INDEX
from grader.marking.extras.league.play_league import time_limits
from grader.marking.journal import Journal
from grader.marking.pool import Pool
from grader.marking.result import Result
from grader.marking.task import MarkingTask, TaskPool
from tests.marking.extras.league.capstones import (
    ASSIGNMENT,
    CRASHES,
    ENDS_LATER,
    IDLE,
    PROGRAMS,
    ROLLS,
    classroom,
    robot,
    write,
)
from tests.marking.tiny import ROOT

SHORT = ("--assignment", ASSIGNMENT, "--unsafe", "--worlds", "2", "--seconds", "4")
CLASS = {"anna": robot(), "dora": CRASHES, "emil": ENDS_LATER, "gus": PROGRAMS}
ITSELF = "Hand in the file itself, as JupyterLab gives it (File, Download)."
KEY = "0" * 32
MAX_SECONDS = "expected at most 2400 s in all warehouses together"


@pytest.fixture(scope="module")
def pool() -> Iterator[Pool]:
    """Where all play but those in the sandbox: to start it takes longer than a game."""
    with Pool(2, unsafe=True, time_limits=time_limits(Contest("", 2, 4))) as pool:
        yield pool


@pytest.fixture(scope="module")
def league(pool) -> Callable[..., int]:
    """Runs the command in a folder."""

    def run(folder: Path, *more: str, pool: TaskPool = pool) -> int:
        with contextlib.chdir(folder):
            return main([*SHORT, *more], lambda *_: contextlib.nullcontext(pool))

    return run


def kept(folder: Path) -> dict[str, str]:
    """What the journal has, by student, without the seconds that it took."""
    journal = Journal(folder / "league" / ASSIGNMENT)
    students = [path.stem for path in journal.folder.glob("*.json") if path.name != ".settings.json"]
    return {student: journal.last(student).result.grade_json() for student in students}


def draw_league(folder: Path) -> None:
    """Draw the class's league from what is known, so that its names are."""
    contest = {"seed": "words", "worlds": 2, "seconds": 4}
    Journal(folder / "class" / "league" / ASSIGNMENT).folder.mkdir(parents=True)
    Journal(folder / "class" / "league" / ASSIGNMENT).save_settings({"contest": contest, "key": KEY})


@pytest.fixture(scope="module")
def played(tmp_path_factory, league) -> Path:
    """A class that has played."""
    folder = classroom(tmp_path_factory.mktemp("played") / "course", CLASS, robot())
    draw_league(folder)
    assert league(folder) == 0
    return folder


def pages(folder: Path) -> dict[str, str]:
    return {path.name: path.read_text() for path in sorted(folder.glob("*.html"))}


def test_a_class_has_a_table_and_a_page_for_each_warehouse(played):
    found = pages(played / "class" / "league")
    assert list(found) == [INDEX, "warehouse_01.html", "warehouse_02.html"]
    assert found["warehouse_01.html"].count('<div class="ros2-replay"') == 4
    assert found["warehouse_02.html"].count('<div class="ros2-replay"') == 3
    assert "The gray shadow is <bdi>the reference</bdi>" in found["warehouse_01.html"]
    assert "The warehouses were drawn from <code>words</code>, which was unknown before." in found[INDEX]


def test_its_pages_say_nothing_of_students_and_quote_no_student(played):
    for text in pages(played / "class" / "league").values():
        # Base64 has any short word somewhere.
        words = re.sub(r'"[A-Za-z0-9+/=]{99,}"', "", text)
        assert not re.search("anna|dora|emil|gus|no map|perception", words)


def test_the_terminal_says_whose_they_are_and_what_went_wrong(league, played, capsys):
    assert league(played) == 0
    output = capsys.readouterr()
    places = re.findall(r"^(\d) +\w+ \w+ +(\w+) +(\d of \d)", output.out, re.M)
    assert [" ".join(place) for place in places] == [
        *("1 dora 0 of 0", "1 anna 0 of 2", "3 emil 0 of 1", "4 gus 0 of 0"),
    ]
    assert "\n   the reference           0 of 2     0       0\n" in output.out
    assert "  Something went wrong in 2 of 2 warehouses, first in 1. ValueError: <b>no map</b>" in output.out
    assert "  Stopped in warehouse 2: from there on, nothing counts. The notebook `robot`" in output.out
    assert "  Did not play. Expected your node's class, or your main function, saw None." in output.out
    index = played / "class" / "league" / INDEX
    assert output.out.endswith(f"\n\n0 played now, 5 in all: {index}\n")
    assert output.err == ""


def test_a_league_is_the_same_when_it_is_played_again_in_another_company(played, tmp_path):
    other = classroom(tmp_path / "course", {"anna": robot(), "emil": ENDS_LATER})
    sandboxed = [word for word in SHORT if word != "--unsafe"]
    with contextlib.chdir(other):
        assert main([*sandboxed, "--seed", "words", "--jobs", "1"]) == 0
    here, there = kept(played / "class"), kept(other / "class")
    assert {student: there[student] == here[student] for student in ("anna", "emil")} == {
        "anna": True,
        "emil": True,
    }
    games = json.loads(here["anna"])["notebooks"][0]["cells"][0]["games"]
    assert len({game["digest"] for game in games}) == 2


def test_other_warehouses_are_played_anew(league, tmp_path, capsys):
    other = classroom(tmp_path / "course", {"gus": PROGRAMS})
    seeds = []
    for more in ((), (), ("--draw",)):
        assert league(other, *more) == 0
        seeds.append(Journal(other / "class" / "league" / ASSIGNMENT).settings()["contest"]["seed"])
    assert seeds[0] == seeds[1] != seeds[2]
    assert re.findall(r"(\d) played now, 1 in all", capsys.readouterr().out) == ["1", "0", "1"]


def test_robots_work_together_with_one_set_of_programs(league, tmp_path):
    ways = {}
    for robots, sandboxed in ((1, False), (2, False), (2, True)):
        course = classroom(tmp_path / f"{robots} {sandboxed}", {"ida": ROLLS})
        words = ["--seed", "words", "--robots", str(robots)]
        if sandboxed:
            with contextlib.chdir(course):
                assert main([*(word for word in SHORT if word != "--unsafe"), *words]) == 0
        else:
            assert league(course, *words) == 0
        games = json.loads(kept(course / "class")["ida"])["notebooks"][0]["cells"][0]["games"]
        ways[robots, sandboxed] = [(game["way"], game["digest"]) for game in games]
    assert ways[2, False] == ways[2, True]
    for (alone, _), (together, _) in zip(ways[1, False], ways[2, True], strict=True):
        assert together == pytest.approx(2 * alone, rel=0.01) and alone > 0.3
    table = pages(course / "class" / "league")[INDEX]
    assert "<p>2 warehouses, 4 s in each with 2 robots, the same for all." in table


class Interrupted:
    """A pool that is interrupted after the first result."""

    def __init__(self, pool: Pool) -> None:
        self._pool = pool

    def mark(self, tasks: Iterable[MarkingTask]) -> Iterator[Result]:
        yield next(self._pool.mark(islice(tasks, 1)))
        raise KeyboardInterrupt


def test_a_league_that_is_interrupted_goes_on(league, pool, tmp_path, capsys):
    other = classroom(tmp_path / "course", {"fay": PROGRAMS, "gus": PROGRAMS})
    assert league(other, pool=Interrupted(pool)) == 130
    stopped = "Stopped. 1 of 2 have played, and their results are stored: the same command continues.\n"
    assert capsys.readouterr().err.endswith(stopped)
    assert not (other / "class" / "league" / INDEX).exists()
    assert league(other) == 0
    assert "\n1 played now, 2 in all: " in capsys.readouterr().out


@pytest.mark.soak
def test_a_league_that_is_killed_goes_on_and_comes_to_the_same_end(league, played, tmp_path):
    other = classroom(tmp_path / "course", CLASS, robot())
    draw_league(other)
    command = [sys.executable, "-m", "grader", "league", *SHORT, "--jobs", "1"]
    environment = {**os.environ, "PYTHONPATH": f"{ROOT}:{ROOT / 'ros_packages/python'}"}
    with subprocess.Popen(command, cwd=other, env=environment, stderr=subprocess.PIPE, text=True) as process:
        assert process.stderr.readline().startswith("1 of 5  ")
        process.kill()
    assert 1 <= len(kept(other / "class")) < 5
    assert league(other) == 0
    assert kept(other / "class") == kept(played / "class")
    assert pages(other / "class" / "league") == pages(played / "class" / "league")


def test_students_compare_versions_of_their_own_in_public_warehouses(league, played, tmp_path, capsys):
    course = classroom(tmp_path / "course", {})
    old, new = write(course / "work" / "old<i>.ipynb", CRASHES), write(course / "work" / "new.ipynb", robot())
    assert league(course, str(old), str(new)) == 0
    output = capsys.readouterr()
    assert sorted(line.partition("  ")[2] for line in output.err.splitlines()) == [
        "new: 0 delivered in 2 warehouses",
        "old<i>: 0 delivered in 2 warehouses",
    ]
    table = pages(course / "work" / "league")[INDEX]
    assert "<bdi>old&lt;i&gt;</bdi>" in table
    assert "&lt;b&gt;no map&lt;/b&gt;" in table
    assert not re.search("<i>|<b>no", "".join(pages(course / "work" / "league").values()))
    assert "These are the public warehouses 0 to 1." in table
    assert "The gray shadow is <bdi>new</bdi>" in pages(course / "work" / "league")["warehouse_01.html"]
    assert kept(course / "work")["new"] != kept(played / "class")["anna"]


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["a/robot.txt"], "expected a notebook such as my_robot.ipynb, saw a/robot.txt"),
        (["a/x.ipynb", "b/x.ipynb"], "two notebooks are called x: give each version a name of its own"),
        (["c/x.ipynb"], "there is no notebook c/x.ipynb"),
        (["d.ipynb"], f"`d.ipynb` is a folder; expected a notebook's file. {ITSELF}"),
        (["--worlds", "99", "a/x.ipynb"], f"{MAX_SECONDS}, saw 99 of 120 s"),
        (["--assignment", "13", "a/x.ipynb"], "expected the assignment 13 in EXERCISES, saw none"),
        ([], f"there are no submissions of {ASSIGNMENT}: put the notebooks into PLACE"),
    ],
)
def test_what_keeps_it_from_working_is_reported(tmp_path, capsys, words, why):
    course = classroom(tmp_path / "course", {})
    (course / "d.ipynb").mkdir()
    for name in ("a", "b"):
        write(course / name / "x.ipynb", IDLE)
    with contextlib.chdir(course):
        assert main(["--assignment", ASSIGNMENT, "--unsafe", *words]) == 1
    output = capsys.readouterr()
    why = why.replace("EXERCISES", str(course / "exercises"))
    why = why.replace("PLACE", str(course / "class" / "submitted" / "STUDENT" / ASSIGNMENT)).rstrip(".")
    assert (output.out, output.err) == ("", f"Not played: {why}.\n")


@pytest.mark.parametrize("number", ["0", "-1", "2.5", "2401"])
def test_a_wrong_number_is_refused(tmp_path, capsys, number):
    with pytest.raises(SystemExit):
        main([f"--worlds={number}"])
    expected = f"error: argument --worlds: expected a whole number from 1 to 2400, saw '{number}'\n"
    assert capsys.readouterr().err.endswith(expected)
