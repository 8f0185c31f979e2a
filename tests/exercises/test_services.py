"""Score tables of 03_services: a page for each exercise in tests/exercises/services/."""

from grader.exercises import services
from tests.exercises.assignment import Assignment
from tests.exercises.score_tables import executed, students
from tests.exercises.seeds import fallen_short
from tests.exercises.services.client import main as client_main


class TestServices(Assignment):
    folder = "03_services"
    package = services

    def test_a_client_of_the_students_own_may_ask_beside_the_course(self):
        score = services.add.grade(students("services", "add")["main"], client_main)
        assert float(score) == services.add.points
        texts = [line.text for line in score.recordings[0].logs if line.node == "sum_client"]
        assert texts[-1] == "Result: 41 + 1 = 42"

    def test_the_frozen_node_of_the_assignment_is_frozen(self):
        text = executed("exercises", self.folder)["ticks-frozen"].text
        assert "has waited since t = 1 s and never returned" in text

    def test_the_lesson_shows_what_it_speaks_of(self):
        cells = executed("course", f"{self.folder}/lesson") | executed("course", f"{self.folder}/parameters")
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


def test_a_robot_that_is_armed_for_a_moment_only_is_as_fast_as_ever():
    """With this seed it is armed for 1.25 s, of which half a second is judged."""
    assert list(fallen_short("services", "arming", range(24, 25))) == []
