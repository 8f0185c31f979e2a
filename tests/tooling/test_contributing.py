"""Types the exercise of CONTRIBUTING.md into a copy of the course, and runs every test of exercises on it."""

import os
import re
import shutil
import subprocess
import sys
import textwrap
import tomllib
from pathlib import Path

import nbformat
import pytest

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
NAME, TOPIC, FOLDER = "battery_level", "topics", "02_topics"
COPIED = "sim", "grader", "ros_packages", "tests", "course", "pyproject.toml", "nbgrader_config.py"
NOTEBOOK = f"solutions/{FOLDER}/{TOPIC}.ipynb"
EXERCISE, PROOF = f"grader/exercises/{TOPIC}/{{}}", f"tests/exercises/{TOPIC}/{{}}"
DELETED = "imu"
WITHOUT_ROW = f"""
from tests.rules.statements import without_row
from tests.rules.table import cells_of, table_of
print(*without_row(table_of("{FOLDER}"), cells_of("{FOLDER}")), sep="\\n")
"""
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


def fill_in(path):
    """Fill in the cells that the guide shows."""
    notebook = nbformat.read(path, 4)
    cells = {cell.id: cell for cell in notebook.cells}
    cells[f"{NAME}-task"].source = f"## 8. A battery ({POINTS} points)"
    cells[NAME].source, cells[f"{NAME}-see"].source = ANSWER.strip(), SEE.strip()
    cells[f"{NAME}-points"].source = f"topics.{NAME}.grade(Battery)"
    cells[f"{NAME}-points"].metadata.nbgrader["points"] = POINTS
    nbformat.write(notebook, path)


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """A copy of the course with the exercise in it, as the guide's steps say."""
    copy = tmp_path_factory.mktemp("copy") / "course"
    for name in (*COPIED, f"solutions/{FOLDER}"):
        source, target = ROOT / name, copy / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            # Compiled modules are copied, too, except those of pytest: they name the original's files.
            shutil.copytree(source, target, ignore=shutil.ignore_patterns("*-pytest-*", "my_*", "ws"))
        else:
            shutil.copy(source, target)
    run(copy, "-m", "tests.exercises", "--new", TOPIC, NAME)
    exercise, nodes = EXERCISE.format(NAME), PROOF.format(NAME)
    (copy / f"{exercise}.py").write_text(f"{FIRST_CHECKS}\n\n{LAST_CHECK}", encoding="utf-8")
    (copy / nodes / "students.py").write_text(STUDENTS, encoding="utf-8")
    fill_in(copy / NOTEBOOK)
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


def test_the_exercise_passes_the_gate_which_writes_the_page_in_the_guide(copy):
    said = run(copy, "-m", "tests.exercises", NAME, "--repeats", "4")
    passed = re.search(r"^(\d+) passed", said, re.M)
    assert passed and int(passed[1]) >= LEAST, said
    assert said.rstrip().endswith("Right nodes earn everything with other seeds and in other orders.")
    assert (copy / PROOF.format(NAME) / "page.txt").read_text(encoding="utf-8") == PAGE


def test_an_exercise_is_gone_with_its_two_folders_and_its_cells(copy):
    """The rules that it looked for are left to the lesson, which has to say why nothing looks for them."""
    (copy / PROOF.format(NAME) / "page.txt").write_text(PAGE, encoding="utf-8")  # as the gate does
    rules = tomllib.loads((copy / PROOF.format(DELETED) / "rules.toml").read_text(encoding="utf-8"))["rule"]
    cells_with_rules = {cell for rule in rules for cell in rule["in"]}
    shutil.rmtree(copy / PROOF.format(DELETED))
    (copy / f"{EXERCISE.format(DELETED)}.py").unlink()
    notebook = nbformat.read(copy / NOTEBOOK, 4)
    notebook.cells = [cell for cell in notebook.cells if cell.id.split("-")[0] != DELETED]
    nbformat.write(notebook, copy / NOTEBOOK)
    assert run(copy, "-c", "from grader.catalog import exercises; print('imu' in exercises())") == "False\n"
    run(copy, "-m", "pytest", "--collect-only", "--assert=plain", "-q", "-n0", "tests/exercises")
    said = run(copy, "-c", WITHOUT_ROW)
    assert {line.partition(":")[0] for line in said.splitlines()} <= cells_with_rules


def test_the_exercise_is_no_longer_than_the_guide_promises():
    most = int(re.search(r"one file of \d+ to (\d+) lines", TEXT)[1])
    assert len(f"{FIRST_CHECKS}\n\n{LAST_CHECK}".splitlines()) <= most
