"""Score tables of 01_nodes: a page for each exercise in tests/exercises/nodes/."""

import pytest

from grader.exercises import nodes
from tests.exercises.score_tables import NOT_STARTED, exercise_of, graded, page, shown, students

EXERCISES = ["hello", "counter", "battery", "heart", "whole_main", "weather"]


@pytest.mark.parametrize(
    ("exercise", "name"), [(exercise, name) for exercise in EXERCISES for name in students("nodes", exercise)]
)
def test_a_node_earns_its_points_and_words(exercise, name):
    score = getattr(nodes, exercise).grade(students("nodes", exercise)[name])
    assert shown(name, score) == page("nodes", exercise).get(name)
    assert score.broken == []


@pytest.mark.parametrize("exercise", EXERCISES)
def test_a_page_speaks_of_every_student_of_its_exercise(exercise):
    assert list(page("nodes", exercise)) == list(students("nodes", exercise))


@pytest.mark.parametrize("exercise", EXERCISES)
def test_a_page_has_three_right_nodes_six_wrong_ones_and_every_sentence(exercise):
    most, blocks = getattr(nodes, exercise).points, page("nodes", exercise).values()
    right = [block for block in blocks if block.endswith(f": {most:g}")]
    assert len(right) >= 3
    assert len(blocks) - len(right) >= 6
    missed = {line[2:] for block in blocks for line in block.splitlines() if line.startswith("- ")}
    assert {check.sentence for check in getattr(nodes, exercise).checks} <= missed


def test_the_solution_earns_everything():
    cells = graded("solutions", "01_nodes")
    assert {name: cell.problems for name, cell in cells.items() if cell.problems} == {}
    assert [cell.points for cell in cells.values()] == [cell.most for cell in cells.values()]
    assert sum(cell.most for cell in cells.values()) == 100


def test_the_starter_earns_nothing_and_is_told_so_kindly():
    for name, cell in graded("exercises", "01_nodes").items():
        assert (name, cell.points, cell.problems) == (name, 0.0, "")
        assert NOT_STARTED in cell.text


def test_a_test_cell_offers_the_points_of_its_exercise():
    cells = graded("solutions", "01_nodes").values()
    assert [exercise_of(cell, nodes) for cell in cells] == [getattr(nodes, name) for name in EXERCISES]
    assert [exercise_of(cell, nodes).points for cell in cells] == [cell.most for cell in cells]
