"""Score tables of 03_services: a page for each exercise in tests/exercises/services/."""

import pytest

from grader.exercises import services
from tests.exercises.score_tables import NOT_STARTED, executed, exercise_of, graded, page, shown, students
from tests.students.services._client import main as client_main

ASSIGNMENT = "03_services"
EXERCISES = ["add", "calibrate", "arming", "door", "ticks", "parameters", "modes"]


def right(exercise):
    """The names of the nodes that earn everything."""
    most = getattr(services, exercise).points
    return [name for name, text in page("services", exercise).items() if text == f"{name}: {most:g}"]


@pytest.mark.parametrize(
    ("exercise", "name"),
    [(exercise, name) for exercise in EXERCISES for name in students("services", exercise)],
)
def test_a_node_earns_its_points_and_words(exercise, name):
    score = getattr(services, exercise).grade(students("services", exercise)[name])
    assert shown(name, score) == page("services", exercise).get(name)
    assert score.broken == []


@pytest.mark.parametrize("exercise", EXERCISES)
def test_a_page_speaks_of_every_student_of_its_exercise(exercise):
    assert list(page("services", exercise)) == list(students("services", exercise))


@pytest.mark.parametrize("exercise", EXERCISES)
def test_a_page_has_three_right_nodes_six_wrong_ones_and_every_sentence(exercise):
    blocks = page("services", exercise).values()
    assert len(right(exercise)) >= 3
    assert len(blocks) - len(right(exercise)) >= 6
    missed = {line[2:] for block in blocks for line in block.splitlines() if line.startswith("- ")}
    assert {check.sentence for check in getattr(services, exercise).checks} <= missed


@pytest.mark.parametrize("exercise", EXERCISES)
def test_other_seeds_change_nothing_for_a_right_node(exercise, monkeypatch):
    monkeypatch.setenv("COURSE_SECRET", "a secret of this test")
    judge, nodes = getattr(services, exercise), students("services", exercise)
    scores = {name: judge.grade(nodes[name]) for name in right(exercise)}
    assert {name: float(score) for name, score in scores.items()} == dict.fromkeys(
        scores, judge.points
    )


def test_a_client_of_the_students_own_may_ask_beside_ours():
    score = services.add.grade(students("services", "add")["main"], client_main)
    assert float(score) == services.add.points
    texts = [line.text for line in score.recordings[0].logs if line.node == "sum_client"]
    assert texts[-1] == "Result: 41 + 1 = 42"


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


def test_the_frozen_node_of_the_assignment_is_frozen():
    text = executed("exercises", ASSIGNMENT)["ticks-frozen"].text
    assert "has waited since t = 1 s and never returned" in text


def test_a_test_cell_offers_the_points_of_its_exercise():
    cells = graded("solutions", ASSIGNMENT).values()
    assert [exercise_of(cell, services) for cell in cells] == [getattr(services, name) for name in EXERCISES]
    assert [exercise_of(cell, services).points for cell in cells] == [cell.most for cell in cells]


def test_the_lesson_shows_what_it_speaks_of():
    cells = executed("course", ASSIGNMENT)
    assert {name: cell.problems for name, cell in cells.items() if cell.problems} == {}
    assert "end it with `return response`" in cells["return-class"].text
    assert "answered at None, lost: True" in cells["late-server"].text
    assert cells["late-cure"].text.count("Waiting for /add_two_ints") == 2
    assert "The boss has logged 0 lines." in cells["raises-run"].text
    assert cells["careless-run"].text.endswith("the robot is at x = 0.00 m\n")
    for frozen in ("deadlock-class", "await-wrong"):
        assert "has waited since t = 1 s and never returned" in cells[frozen].text
    assert cells["await-right"].text.count("I am well") == 4
    assert cells["threads-run"].text.count("The sum is 5") == 2
    assert cells["stream-poor"].text == "300 requests and responses\n"
    assert cells["stream-good"].text.startswith("50 messages")
    assert "declared as DOUBLE" in cells["kinds-run"].text
    assert cells["check-values-run"].text.count("successful=False") == 2
    assert "ZeroDivisionError" in cells["check-values-without-run"].text
    assert "power off" in cells["together-run"].text
