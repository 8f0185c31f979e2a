"""Score tables of 01_nodes: a page for each exercise in tests/exercises/nodes/."""

from grader.exercises import nodes
from tests.exercises.assignment import Assignment
from tests.exercises.score_tables import executed


class TestNodes(Assignment):
    folder = "01_nodes"
    package = nodes

    def test_the_lesson_shows_what_it_speaks_of(self):
        cells = executed("course", self.folder)
        assert {name: cell.problems for name, cell in cells.items() if cell.problems} == {}
        assert cells["first-node-run"].text == "[INFO] [0.000] [greeter]: I am up\n"
        assert "voltage" not in cells["levels-class"].text
        assert "[DEBUG]" in cells["levels-debug-class"].text
        assert "severity cannot be changed" in cells["levels-wrong-class"].text
        assert "'NoneType' object is not callable" in cells["timer-brackets-class"].text
        assert "['/left/lamp', '/right/lamp', '/roof_lamp']" in cells["names-process-run"].text
        careless, careful = cells["main-finally-run"].text.split("careful_main")
        assert "Light off" not in careless
        assert "Light off" in careful
        assert cells["modules-reload-run"].text == "False\nTrue\n"
