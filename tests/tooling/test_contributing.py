"""Builds the exercise in CONTRIBUTING.md from that page, and grades its nodes."""

import importlib.util
import re
import sys
import textwrap
from pathlib import Path

import pytest

from grader import Exercise
from tests.exercises.score_tables import shown

TEXT = Path(__file__).parents[2].joinpath("CONTRIBUTING.md").read_text(encoding="utf-8")
IMPORTS = "from rclpy.node import Node\nfrom std_msgs.msg import Float32\n"


def blocks(title, language):
    """The code blocks of a section, in their order."""
    section = TEXT.split(f"\n## {title}\n")[1].split("\n## ")[0]
    found = re.findall(rf"^( *)```{language}\n(.*?)^\1```$", section, re.M | re.S)
    return [textwrap.dedent(text) for _, text in found]


FIRST_CHECKS, ANSWER, STUDENTS = blocks("Add an exercise", "python")
PAGE = dict(block.split(": ", 1) for block in blocks("Add an exercise", "text")[0].strip().split("\n\n"))


@pytest.fixture(scope="module")
def module(tmp_path_factory):
    """Makes a module of a text, as if it lay in the course."""
    made = []

    def make(name, text):
        path = tmp_path_factory.mktemp("course") / f"{name}.py"
        path.write_text(text, encoding="utf-8")
        spec = importlib.util.spec_from_file_location(name, path)
        found = sys.modules[name] = importlib.util.module_from_spec(spec)
        made.append(name)
        spec.loader.exec_module(found)
        return found

    yield make
    for name in made:
        del sys.modules[name]


@pytest.fixture(scope="module")
def exercise(module):
    (last_check,) = blocks("Add a check", "python")
    return module("contributed_exercise", FIRST_CHECKS + "\n\n" + last_check).battery_level


@pytest.fixture(scope="module")
def students(module):
    return module("contributed_students", IMPORTS + STUDENTS)


def test_the_exercise_is_three_checks(exercise):
    assert isinstance(exercise, Exercise)
    names = [check.name for check in exercise.checks]
    assert names == ["publishes_levels", "twice_a_second", "warns_below_20"]


@pytest.mark.parametrize("name", PAGE)
def test_a_node_earns_the_points_and_words_on_the_page(exercise, students, name):
    score = exercise.grade(getattr(students, name))
    assert shown(name, score) == f"{name}: {PAGE[name]}"
    assert score.broken == []


def test_only_the_right_node_earns_everything(exercise):
    full = [name for name, text in PAGE.items() if text == f"{exercise.points:g}"]
    assert full == ["Battery"]
    assert set(PAGE) == {"Battery", "AlwaysAt90", "AlwaysWarns", "NeverWarns", "OnceASecond"}


def test_the_answer_in_the_notebook_earns_everything(exercise, module):
    answer = module("contributed_answer", IMPORTS + ANSWER)
    assert exercise.grade(answer.Battery) == exercise.points
