"""Score tables of 06_navigator: a page for each exercise in tests/exercises/navigator/."""

import pytest

from grader.exercises import navigator
from tests.exercises.score_tables import NOT_STARTED, exercise_of, graded, page, shown, students

ASSIGNMENT = "06_navigator"
EXERCISES = ["compass", "drive", "costmap", "plan", "follow", "navigate"]


def right(exercise):
    """The names of the nodes that earn everything."""
    most = getattr(navigator, exercise).points
    return [name for name, text in page("navigator", exercise).items() if text == f"{name}: {most:g}"]


@pytest.mark.parametrize(
    ("exercise", "name"),
    [(exercise, name) for exercise in EXERCISES for name in students("navigator", exercise)],
)
def test_a_node_earns_its_points_and_words(exercise, name):
    score = getattr(navigator, exercise).grade(students("navigator", exercise)[name])
    assert shown(name, score) == page("navigator", exercise).get(name)
    assert score.broken == []


@pytest.mark.parametrize("exercise", EXERCISES)
def test_a_page_speaks_of_every_student_of_its_exercise(exercise):
    assert list(page("navigator", exercise)) == list(students("navigator", exercise))


@pytest.mark.parametrize("exercise", EXERCISES)
def test_a_page_has_three_right_nodes_six_wrong_ones_and_every_sentence(exercise):
    blocks = page("navigator", exercise).values()
    assert len(right(exercise)) >= 3
    assert len(blocks) - len(right(exercise)) >= 6
    missed = {line[2:] for block in blocks for line in block.splitlines() if line.startswith("- ")}
    assert {check.sentence for check in getattr(navigator, exercise).checks} <= missed


@pytest.mark.parametrize("exercise", EXERCISES)
def test_other_seeds_change_nothing_for_a_right_node(exercise, monkeypatch):
    monkeypatch.setenv("COURSE_SECRET", "a secret of this test")
    judge, nodes = getattr(navigator, exercise), students("navigator", exercise)
    scores = {name: float(judge.grade(nodes[name])) for name in right(exercise)}
    assert scores == dict.fromkeys(scores, judge.points)


def test_a_tutorials_listing_with_a_fixed_goal_is_right_as_it_is():
    assert "tutorial_main" in right("drive")


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
        assert cell.most == exercise_of(cell, navigator).points
