"""The real course, marked by the real command; then nbgrader's own commands on what it made."""
import csv
import re
import shutil
import subprocess
import sys

import pytest
from nbgrader.api import Gradebook

from grader.exercise import Exercise
from grader.exercises import nodes
from grader.marking.release.make_exercises import copy_of_course, release
from grader.marking.release.nbgrader_command import nbgrader
from grader.marking.release.samples import submit_samples
from grader.marking.secret import ACCEPTED
from tests.marking.tiny import ROOT

SECRET = "d1ce" * 16
MOST = sum(each.points for each in vars(nodes).values() if isinstance(each, Exercise))
HIDDEN = (SECRET, "COURSE_SECRET", "site-packages", str(ROOT), "Traceback (most recent")


@pytest.fixture(scope="module")
def marked(tmp_path_factory):
    """A class with a right, a half right, an untouched and a broken submission, and what the command said.

    Its folder is a second copy of the course, which uses the .venv of this one.
    """
    course = copy_of_course(ROOT, tmp_path_factory.mktemp("course"))
    for other in set((course / "solutions").iterdir()) - {course / "solutions" / "01_nodes"}:
        shutil.rmtree(other)
    for package in ("grader", "sim", "ros_packages"):
        shutil.copytree(ROOT / package, course / package, ignore=shutil.ignore_patterns("__pycache__"))
    release(course)
    submit_samples(course, "01_nodes")
    broken = course / "class" / "submitted" / "zoe" / "01_nodes"
    broken.mkdir(parents=True)
    (broken / "nodes.ipynb").write_text("")
    (course / ".secret").touch(mode=0o600)
    (course / ".secret").write_text(SECRET)
    command = [sys.executable, "-m", "grader", "mark", "01_nodes", "--jobs", "2"]
    done = subprocess.run(command, cwd=course, text=True, capture_output=True)
    assert done.returncode == 0, done.stderr
    return course, done.stdout


def scores(course):
    with Gradebook(f"sqlite:///{course}/class/gradebook.db", "ros2") as book:
        return {found.student.id: found.score for found in book.assignment_submissions("01_nodes")}


def pages(course):
    return {path.parts[-3]: path.read_text() for path in (course / "class" / "feedback").rglob("*.html")}


def test_the_command_says_what_everybody_has(marked):
    _, message = marked
    totals = dict(re.findall(r"^(\w+) .*? (\d+)   ?(?:marked|refused)$", message, re.M))
    assert (totals["right"], totals["wrong"], totals["zoe"]) == (f"{MOST:g}", "0", "0")
    assert re.search(r"zoe: refused: .*`nodes\.ipynb`", message)
    assert "\n4 marked now, 4 of 4 in all, in " in message


@pytest.mark.soak
def test_nbgrader_exports_the_same_points(marked):
    course, _ = marked
    nbgrader(course, "export")
    with open(course / "class" / "grades.csv") as file:
        exported = {row["student_id"]: float(row["score"]) for row in csv.DictReader(file)}
    assert exported == scores(course)
    assert (exported["right"], exported["wrong"], exported["zoe"]) == (MOST, 0, 0)
    assert 0 < exported["half_right"] < MOST


def test_pages_show_scores_and_verdicts_and_nothing_of_the_instructors(marked):
    course, _ = marked
    shown = pages(course)
    assert set(shown) == {"right", "half_right", "wrong", "zoe"}
    assert "Your submission could not be marked." in shown["zoe"]
    assert "points</b></caption>" in shown["right"]
    for page in shown.values():
        assert [word for word in (*HIDDEN, str(course)) if word in page] == []


@pytest.mark.soak
def test_nbgraders_own_feedback_and_autograde_take_it_as_it_is(marked):
    course, _ = marked
    before, points = pages(course), scores(course)
    nbgrader(course, "generate_feedback", "01_nodes", "--force")
    assert pages(course) == before
    # It skips what is marked, as after its own marking.
    nbgrader(course, "autograde", "01_nodes", **{ACCEPTED: "yes"})
    assert scores(course) == points


def test_the_instructors_process_has_no_ros_context_and_no_jupyter_kernel():
    code = (
        "import sys, grader.marking.command.cli\n"
        "from rclpy.utilities import get_default_context\n"
        "assert not get_default_context().ok()\n"
        "assert 'ipykernel' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True, cwd=ROOT)
