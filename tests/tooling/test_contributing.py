"""Types the exercise of CONTRIBUTING.md into a copy of the course, and runs every test of exercises on it."""

import os
import re
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
NAME, TOPIC, FOLDER = "battery_level", "topics", "02_topics"
COPIED = "sim", "grader", "ros_packages", "tests", "pyproject.toml", "nbgrader_config.py"
GATES = ("test_topics.py", "test_adversaries.py", "test_hints.py")
POINTS = 15
LEAST = 20  # tests that must have looked at the exercise


def blocks(title, language):
    """The code blocks of a section, in their order."""
    section = TEXT.split(f"\n## {title}\n")[1].split("\n## ")[0]
    found = re.findall(rf"^( *)```{language}\n(.*?)^\1```$", section, re.M | re.S)
    return [textwrap.dedent(text) for _, text in found]


FIRST_CHECKS, ANSWER, SEE, STUDENTS = blocks("Add an exercise", "python")
LAST_CHECK = blocks("Add a check", "python")[0]
PAGE = blocks("Add an exercise", "text")[0]


def cells():
    """The four cells of the exercise in its notebook."""
    answer = {
        "grade": False,
        "grade_id": NAME,
        "locked": False,
        "schema_version": 3,
        "solution": True,
        "task": False,
    }
    points = answer | {
        "grade": True,
        "grade_id": f"{NAME}-points",
        "locked": True,
        "points": POINTS,
        "solution": False,
    }
    return [
        new_markdown_cell(f"## 8. A battery ({POINTS} points)", id=f"{NAME}-task"),
        new_code_cell(ANSWER.strip(), id=NAME, metadata={"nbgrader": answer}),
        new_code_cell(SEE.strip(), id=f"{NAME}-see"),
        new_code_cell(f"topics.{NAME}.grade(Battery)", id=f"{NAME}-points", metadata={"nbgrader": points}),
    ]


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """A copy of the course with the exercise in it, as the guide's six steps say."""
    copy = tmp_path_factory.mktemp("copy") / "course"
    for name in (*COPIED, f"solutions/{FOLDER}"):
        source, target = ROOT / name, copy / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            shutil.copytree(source, target, ignore=shutil.ignore_patterns("__pycache__", "my_*", "ws"))
        else:
            shutil.copy(source, target)
    exercises, students = copy / "grader/exercises" / TOPIC, copy / "tests/students" / TOPIC
    (exercises / f"{NAME}.py").write_text(f"{FIRST_CHECKS}\n\n{LAST_CHECK}", encoding="utf-8")
    with (exercises / "__init__.py").open("a", encoding="utf-8") as names:
        names.write(f"\nfrom grader.exercises.{TOPIC}.{NAME} import {NAME}\n")
    (students / f"{NAME}.py").write_text(STUDENTS, encoding="utf-8")
    path = copy / "solutions" / FOLDER / f"{TOPIC}.ipynb"
    notebook = nbformat.read(path, 4)
    notebook.cells += cells()
    nbformat.write(notebook, path)
    run(copy, "-m", "tests.exercises.score_tables", f"{TOPIC}/{NAME}")
    run(copy, "-m", "grader.marking.release.make_exercises")
    for other in (ROOT / "solutions").iterdir():  # their notebooks say which exercises there are
        if other.is_dir() and other.name != FOLDER:
            shutil.copytree(other, copy / "solutions" / other.name)
    return copy


def run(copy, *words):
    """Run Python in the copy; its output, for the message of a failure."""
    paths = os.pathsep.join(map(str, (copy, copy / "ros_packages/python")))
    environment = {**os.environ, "PYTHONPATH": paths, "PYTEST_XDIST_WORKER": "", "PYTEST_ADDOPTS": ""}
    done = subprocess.run([sys.executable, *words], cwd=copy, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout[-5000:] + done.stderr[-5000:]
    return done.stdout


def test_the_page_in_the_guide_is_the_page_that_is_written(copy):
    page = copy / "tests/exercises" / TOPIC / f"{NAME}.txt"
    assert page.read_text(encoding="utf-8") == PAGE


def test_the_exercise_passes_every_test_of_exercises(copy):
    files = [f"tests/exercises/{name}" for name in GATES]
    chosen = f"{NAME} or starter or test_cell or every_exercise or hints"
    said = run(copy, "-m", "pytest", "-q", "-n0", "-p", "no:cacheprovider", "-k", chosen, *files)
    passed = re.search(r"^(\d+) passed", said, re.M)
    assert passed and int(passed[1]) >= LEAST, said


def test_the_exercise_is_no_longer_than_the_guide_promises():
    most = int(re.search(r"one file of \d+ to (\d+) lines", TEXT)[1])
    assert len(f"{FIRST_CHECKS}\n\n{LAST_CHECK}".splitlines()) <= most
