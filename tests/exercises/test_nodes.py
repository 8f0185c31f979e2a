"""Score tables of 01_nodes: a page for each exercise in tests/exercises/nodes/."""

import pytest

from grader.exercises import nodes
from tests.exercises.score_tables import NOT_STARTED, executed, exercise_of, graded, page, shown, students

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


def test_the_starter_says_so_wherever_a_node_is_run():
    cells = executed("exercises", "01_nodes")
    assert {name: cell.problems for name, cell in cells.items() if cell.problems} == {}
    said = [cell.text for name, cell in cells.items() if name.endswith("-see")]
    assert len(said) == len(EXERCISES)
    assert all(text.startswith("Not started yet: write your code") for text in said)


def test_the_lesson_shows_what_it_speaks_of():
    cells = executed("course", "01_nodes")
    assert {name: cell.problems for name, cell in cells.items() if cell.problems} == {}
    assert cells["first-node-run"].text == "[INFO] [0.000] [greeter]: I am up\n"
    assert "voltage" not in cells["levels-class"].text
    assert "[DEBUG]" in cells["levels-debug-class"].text
    assert "severity cannot be changed" in cells["levels-wrong-class"].text
    assert "'NoneType' object is not callable" in cells["timer-brackets-class"].text
    assert cells["waiting-other-class"].text == "[2.5, 4.5, 6.5]\n"
    assert "['/left/lamp', '/right/lamp', '/roof_lamp']" in cells["names-process-run"].text
    careless, careful = cells["main-finally-run"].text.split("careful_main")
    assert "Light off" not in careless
    assert "Light off" in careful
    assert cells["modules-reload-run"].text == "False\nTrue\n"


def test_a_test_cell_offers_the_points_of_its_exercise():
    cells = graded("solutions", "01_nodes").values()
    assert [exercise_of(cell, nodes) for cell in cells] == [getattr(nodes, name) for name in EXERCISES]
    assert [exercise_of(cell, nodes).points for cell in cells] == [cell.most for cell in cells]
