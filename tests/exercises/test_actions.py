"""Score tables of 04_actions: a page for each exercise in tests/exercises/actions/."""

import pytest

from grader.exercises import actions
from tests.exercises.score_tables import NOT_STARTED, executed, exercise_of, graded, page, shown, students

ASSIGNMENT = "04_actions"
EXERCISES = ["fibonacci", "steps", "customer", "stoppable", "turn", "courier", "square"]


def right(exercise):
    """The names of the nodes that earn everything."""
    most = getattr(actions, exercise).points
    return [name for name, text in page("actions", exercise).items() if text == f"{name}: {most:g}"]


@pytest.mark.parametrize(
    ("exercise", "name"),
    [(exercise, name) for exercise in EXERCISES for name in students("actions", exercise)],
)
def test_a_node_earns_its_points_and_words(exercise, name):
    score = getattr(actions, exercise).grade(students("actions", exercise)[name])
    assert shown(name, score) == page("actions", exercise).get(name)
    assert score.broken == []


@pytest.mark.parametrize("exercise", EXERCISES)
def test_a_page_speaks_of_every_student_of_its_exercise(exercise):
    assert list(page("actions", exercise)) == list(students("actions", exercise))


@pytest.mark.parametrize("exercise", EXERCISES)
def test_a_page_has_three_right_nodes_six_wrong_ones_and_every_sentence(exercise):
    blocks = page("actions", exercise).values()
    assert len(right(exercise)) >= 3
    assert len(blocks) - len(right(exercise)) >= 6
    missed = {line[2:] for block in blocks for line in block.splitlines() if line.startswith("- ")}
    assert {check.sentence for check in getattr(actions, exercise).checks} <= missed


@pytest.mark.parametrize("exercise", EXERCISES)
def test_other_seeds_change_nothing_for_a_right_node(exercise, monkeypatch):
    monkeypatch.setenv("COURSE_SECRET", "a secret of this test")
    judge, nodes = getattr(actions, exercise), students("actions", exercise)
    scores = {name: judge.grade(nodes[name]) for name in right(exercise)}
    assert {name: float(score) for name, score in scores.items()} == dict.fromkeys(scores, judge.points)


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
    assert [exercise_of(cell, actions) for cell in cells] == [getattr(actions, name) for name in EXERCISES]
    assert [exercise_of(cell, actions).points for cell in cells] == [cell.most for cell in cells]


def test_the_lesson_shows_what_it_speaks_of():
    cells = executed("course", ASSIGNMENT)
    assert {name: cell.problems for name, cell in cells.items() if cell.problems} == {}
    assert cells["why-run"].text.endswith("asked at 1.0 s, answered at 7.0 s\n")
    assert cells["forget-run"].text.endswith("['accepted', 'executing', 'aborted']\n")
    assert "lost: True" in cells["lost-run"].text
    assert cells["reject-run"].text.endswith("[(1.0, 'rejected')]\n")
    assert "did not return a GoalResponse" in cells["reject-true"].text
    for deaf in ("cancel-run", "threads-group-run"):
        assert cells[deaf].text.endswith("5.5 s  succeeded\n5.5 s  cancel rejected\n")
    for heard in ("threads-run", "pause-server"):
        assert "status 5, result [0, 1, 1, 2, 3]" in cells[heard].text
    assert cells["drive-blind-run"].text == "the robot is at x = 2.76 m, and the goal is executing\n"
    assert "canceled after 0.98 m" in cells["honest-cancel"].text
    assert "DishonestServer: 0.22 m further" in cells["dishonest-run"].text
    assert "status 6: only 0.50 m in 5 s" in cells["limit-run"].text
    assert "succeeded at 4.04 rad" in cells["spin-run"].text
    assert "canceled after 0.24 m" in cells["patience-run"].text
    assert cells["levels-run"].text.count(" m\n") == 4
    assert "status 6: replaced after 0.78 m" in cells["preempt-run"].text
    assert cells["together-run"].text.count(": done\n") == 4
