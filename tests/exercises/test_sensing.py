"""Score tables of 05_sensing: a page for each exercise in tests/exercises/sensing/."""

import pytest

from grader.exercises import sensing
from tests.exercises.score_tables import NOT_STARTED, executed, exercise_of, graded, page, shown, students

ASSIGNMENT = "05_sensing"
EXERCISES = ["stop", "sectors", "avoid", "heading", "gyro", "wall", "guard"]


def right(exercise):
    """The names of the nodes that earn everything."""
    most = getattr(sensing, exercise).points
    return [name for name, text in page("sensing", exercise).items() if text == f"{name}: {most:g}"]


@pytest.mark.parametrize(
    ("exercise", "name"),
    [(exercise, name) for exercise in EXERCISES for name in students("sensing", exercise)],
)
def test_a_node_earns_its_points_and_words(exercise, name):
    score = getattr(sensing, exercise).grade(students("sensing", exercise)[name])
    assert shown(name, score) == page("sensing", exercise).get(name)
    assert score.broken == []


@pytest.mark.parametrize("exercise", EXERCISES)
def test_a_page_speaks_of_every_student_of_its_exercise(exercise):
    assert list(page("sensing", exercise)) == list(students("sensing", exercise))


@pytest.mark.parametrize("exercise", EXERCISES)
def test_a_page_has_three_right_nodes_six_wrong_ones_and_every_sentence(exercise):
    blocks = page("sensing", exercise).values()
    assert len(right(exercise)) >= 3
    assert len(blocks) - len(right(exercise)) >= 6
    missed = {line[2:] for block in blocks for line in block.splitlines() if line.startswith("- ")}
    assert {check.sentence for check in getattr(sensing, exercise).checks} <= missed


@pytest.mark.parametrize("exercise", EXERCISES)
def test_other_worlds_and_seeds_change_nothing_for_a_right_node(exercise, monkeypatch):
    monkeypatch.setenv("COURSE_SECRET", "a secret of this test")
    judge, nodes = getattr(sensing, exercise), students("sensing", exercise)
    scores = {name: float(judge.grade(nodes[name])) for name in right(exercise)}
    assert scores == dict.fromkeys(scores, judge.points)


def test_the_solution_earns_everything():
    cells = graded("solutions", ASSIGNMENT)
    assert {name: cell.problems for name, cell in cells.items() if cell.problems} == {}
    assert [cell.points for cell in cells.values()] == [cell.most for cell in cells.values()]
    assert sum(cell.most for cell in cells.values()) == 100


def test_the_starter_earns_nothing_and_is_told_so_kindly():
    for name, cell in graded("exercises", ASSIGNMENT).items():
        assert (name, cell.points, cell.problems) == (name, 0.0, "")
        assert NOT_STARTED in cell.text


def test_the_starter_says_so_wherever_a_node_is_run():
    cells = executed("exercises", ASSIGNMENT)
    assert {name: cell.problems for name, cell in cells.items() if cell.problems} == {}
    said = [cell.text for name, cell in cells.items() if name.endswith("-see")]
    assert len(said) == len(EXERCISES)
    assert all("Not started yet: write your code" in text for text in said)


def test_a_test_cell_offers_the_points_of_its_exercise():
    cells = graded("solutions", ASSIGNMENT).values()
    assert [exercise_of(cell, sensing) for cell in cells] == [getattr(sensing, name) for name in EXERCISES]
    assert [exercise_of(cell, sensing).points for cell in cells] == [cell.most for cell in cells]
