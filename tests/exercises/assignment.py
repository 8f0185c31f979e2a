"""What holds for every assignment: score tables, solution, starter. Each has a subclass in test_*.py."""

from __future__ import annotations

from types import ModuleType
from typing import ClassVar

import pytest

from grader import Exercise
from tests.exercises.score_tables import NOT_STARTED, executed, exercise_of, graded, page, shown, students


class Assignment:
    """The tests of one assignment.

    folder: its name in solutions/. package: its exercises. names: its exercises, in the notebook's order.
    """

    folder: ClassVar[str]
    package: ClassVar[ModuleType]
    names: ClassVar[tuple[str, ...]]

    def pytest_generate_tests(self, metafunc: pytest.Metafunc) -> None:
        """Run a test for each exercise, or for each of its nodes, as its arguments ask."""
        if "node" in metafunc.fixturenames:
            pairs = [(name, node) for name in self.names for node in students(self.topic(), name)]
            metafunc.parametrize(("exercise", "node"), pairs)
        elif "exercise" in metafunc.fixturenames:
            metafunc.parametrize("exercise", self.names)

    @classmethod
    def topic(cls) -> str:
        """The assignment's name without its number."""
        return cls.folder.split("_", 1)[1]

    @classmethod
    def judge(cls, exercise: str) -> Exercise:
        """The exercise of this name."""
        return getattr(cls.package, exercise)

    @classmethod
    def right(cls, exercise: str) -> list[str]:
        """The names of the nodes that earn everything."""
        most = cls.judge(exercise).points
        return [name for name, text in page(cls.topic(), exercise).items() if text == f"{name}: {most:g}"]

    def test_a_node_earns_its_points_and_words(self, exercise, node):
        score = self.judge(exercise).grade(students(self.topic(), exercise)[node])
        assert shown(node, score) == page(self.topic(), exercise).get(node)
        assert score.broken == []

    def test_a_page_speaks_of_every_student_of_its_exercise(self, exercise):
        assert list(page(self.topic(), exercise)) == list(students(self.topic(), exercise))

    def test_a_page_has_three_right_nodes_six_wrong_ones_and_every_sentence(self, exercise):
        blocks = page(self.topic(), exercise).values()
        assert len(self.right(exercise)) >= 3
        assert len(blocks) - len(self.right(exercise)) >= 6
        missed = {line[2:] for block in blocks for line in block.splitlines() if line.startswith("- ")}
        assert {check.sentence for check in self.judge(exercise).checks} <= missed

    def test_the_solution_earns_everything(self):
        cells = graded("solutions", self.folder)
        assert {name: cell.problems for name, cell in cells.items() if cell.problems} == {}
        assert [cell.points for cell in cells.values()] == [cell.most for cell in cells.values()]
        assert sum(cell.most for cell in cells.values()) == 100

    def test_the_starter_earns_nothing_and_is_told_so_kindly(self):
        for name, cell in graded("exercises", self.folder).items():
            assert (name, cell.points, cell.problems) == (name, 0.0, "")
            assert NOT_STARTED in cell.text

    def test_the_starter_says_so_wherever_a_node_is_run(self):
        cells = executed("exercises", self.folder)
        assert {name: cell.problems for name, cell in cells.items() if cell.problems} == {}
        said = [cell.text for name, cell in cells.items() if name.endswith("-see")]
        assert len(said) == len(self.names)
        assert all("Not started yet: write your code" in text for text in said)

    def test_a_test_cell_offers_the_points_of_its_exercise(self):
        cells = graded("solutions", self.folder).values()
        offered = [exercise_of(cell, self.package) for cell in cells]
        assert offered == [self.judge(name) for name in self.names]
        assert [exercise.points for exercise in offered] == [cell.most for cell in cells]
