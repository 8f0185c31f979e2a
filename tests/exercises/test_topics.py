"""Score tables of 02_topics: a page for each exercise in tests/exercises/topics/.

A page has the nodes of the exercise's module in tests/students/topics/, what they earn, and the red lines
they get, word by word.
"""

import importlib
from pathlib import Path

import pytest

from grader.exercises import topics
from sim import Process
from tests.exercises.score_tables import NOT_STARTED, exercise_of, graded, misses

ASSIGNMENT = "02_topics"
EXERCISES = ["greeting", "temperature", "commands", "chatters", "imu", "remapping", "square"]
PAGES = Path(__file__).with_name("topics")


def students(exercise):
    """Name to node, for every node of an exercise's module that is there to be graded."""
    module = importlib.import_module(f"tests.students.topics.{exercise}")
    found = {
        name: item
        for name, item in vars(module).items()
        if isinstance(item, Process) or getattr(item, "__module__", "") == module.__name__
    }
    return {name: item for name, item in found.items() if name not in getattr(module, "PARTS", ())}


def page(exercise):
    """Name to the text below it on the exercise's page: points, and the red lines."""
    blocks = (PAGES / f"{exercise}.txt").read_text(encoding="utf-8").strip().split("\n\n")
    return {block.split(":")[0]: block for block in blocks}


def shown(name, score):
    """What a page says of a node."""
    lines = [f"{name}: {score!r}"]
    for miss in misses(score):
        lines.append(f"- {miss.sentence}")
        lines += [f"  Expected: {miss.expected}", f"  Saw: {miss.saw}", f"  Hint: {miss.hint}".rstrip()]
    return "\n".join(lines)


@pytest.mark.parametrize(
    ("exercise", "name"), [(exercise, name) for exercise in EXERCISES for name in page(exercise)]
)
def test_a_node_earns_its_points_and_words(exercise, name):
    score = getattr(topics, exercise).grade(students(exercise)[name])
    assert shown(name, score) == page(exercise)[name]
    assert score.broken == []


@pytest.mark.parametrize("exercise", EXERCISES)
def test_every_student_of_an_exercise_is_on_its_page(exercise):
    assert list(page(exercise)) == list(students(exercise))


@pytest.mark.parametrize("exercise", EXERCISES)
def test_a_page_has_three_right_nodes_six_wrong_ones_and_every_sentence(exercise):
    most = getattr(topics, exercise).points
    blocks = page(exercise).values()
    right = [block for block in blocks if block.endswith(f": {most:g}")]
    assert len(right) >= 3
    assert len(blocks) - len(right) >= 6
    missed = {line[2:] for block in blocks for line in block.splitlines() if line.startswith("- ")}
    assert {check.sentence for check in getattr(topics, exercise).checks} <= missed


def test_other_seeds_change_nothing(monkeypatch):
    monkeypatch.setenv("COURSE_SECRET", "a secret of this test")
    for exercise in EXERCISES:
        best = next(iter(students(exercise).values()))
        assert float(getattr(topics, exercise).grade(best)) == getattr(topics, exercise).points


def test_the_solution_earns_everything():
    cells = graded("solutions", ASSIGNMENT)
    assert {name: cell.problems for name, cell in cells.items() if cell.problems} == {}
    assert [cell.points for cell in cells.values()] == [cell.most for cell in cells.values()]
    assert sum(cell.most for cell in cells.values()) == 100


def test_the_starter_earns_nothing_and_is_told_so_kindly():
    for name, cell in graded("exercises", ASSIGNMENT).items():
        assert (name, cell.points, cell.problems) == (name, 0.0, "")
        assert NOT_STARTED in cell.text


def test_a_test_cell_offers_the_points_of_its_exercise():
    for cell in graded("solutions", ASSIGNMENT).values():
        assert cell.most == exercise_of(cell, topics).points
