"""What holds for every assignment: score tables, solution, starter. Each has a subclass in test_*.py."""

from __future__ import annotations

import copy
import functools
import re
from types import ModuleType
from typing import Any, ClassVar

import pytest

from grader import Exercise, Score
from grader.companions.parameter_start import REFUSED
from grader.diagnosis import find_flaw
from tests.exercises.at_times import TIMES, working
from tests.exercises.evidence import Evidence
from tests.exercises.orders import fallen_short_in_orders
from tests.exercises.score_tables import (
    NOT_STARTED,
    executed,
    exercise_of,
    folder_of,
    graded,
    graded_exercises,
    page,
    shown,
    students,
)
from tests.exercises.seeds import SOLUTION, fallen_short, right_nodes
from tests.students.teams import programs_of

PRIVATE = 8, 50  # other seeds, at least and at most, as students get them; tests.exercises.seeds tries more
PRIVATE_SECONDS = 1500.0  # of simulated time, for which an exercise is tried with other seeds
ORDERS, ORDERS_OF_PACKAGES = 20, 8  # tried with each exercise; tests.exercises.orders tries more
LONG = 15.0  # s of simulated time, of all runs of an exercise
LONGEST = 300.0  # s of simulated time: of what takes that long, only three rows are run each day
# The docstring of a node says so, or the line that makes it.
DESIGN = re.compile(
    r'^(?:class|def) (\w+)\b[^\n]*:\n    """A design of its own: |^(\w+) = [^\n]*# a design of its own', re.M
)
FIRST_WITH_DESIGNS = "03"
# What a page says that a node misses.
SHOWN = re.compile(r"^- (.*)$", re.M)
SHOWN_WITH_HINT = re.compile(r"^- (.*)\n  Expected: .*\n  Saw: (?:.*\n)*?  Hint:(.*)$", re.M)
RAISED = re.compile(r"^  Saw: \w*(Error|Exception)\b", re.M)


def simulated(exercise: Exercise) -> float:
    """Seconds of simulated time of all its runs together."""
    return sum(scenario.seconds for scenario, _ in exercise.runs())


def is_long(exercise: Exercise) -> bool:
    """Whether its runs are so long that soak tests alone run all that is tried with it."""
    return simulated(exercise) >= LONG


def is_slow(exercise: Exercise) -> bool:
    """Whether it takes long, or has a package: to build one takes 2 s."""
    return is_long(exercise) or bool(exercise.package)


def first_run(exercise: Exercise) -> Exercise:
    """The exercise with its first run only; whole where a check holds in some of its scenarios only."""
    if any(check.only for check in exercise.checks):
        return exercise
    short = copy.copy(exercise)
    short.seeds, short.scenarios = exercise.seeds[:1], exercise.scenarios[:1]
    return short


class Assignment:
    """The tests of one assignment.

    folder: its name in solutions/. package: its exercises. names: those that its notebook grades, in order.
    """

    folder: ClassVar[str]
    package: ClassVar[ModuleType]
    names: ClassVar[tuple[str, ...]]

    def __init_subclass__(cls) -> None:
        cls.names = graded_exercises(cls.folder)

    def pytest_generate_tests(self, metafunc: pytest.Metafunc) -> None:
        """Run a test for each exercise, or for each of its nodes, as its arguments ask."""
        if "times" in metafunc.fixturenames:
            rows = [
                pytest.param(name, times, marks=[pytest.mark.soak] if is_long(self.judge(name)) else [])
                for name in self.names
                for times in TIMES
            ]
            metafunc.parametrize(("exercise", "times"), rows)
        elif "node" in metafunc.fixturenames:
            rows = [self.row(name, node) for name in self.names for node in students(self.topic(), name)]
            metafunc.parametrize(("exercise", "node"), rows)
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
        return right_nodes(cls.topic(), exercise)

    @classmethod
    @functools.cache
    def daily(cls, exercise: str) -> list[str]:
        """The nodes that each run of the tests looks at.

        The right ones, and as few wrong ones as together show every sentence with each of its hints. For a
        slow exercise one right one, and as few wrong ones as miss every sentence.
        """
        judge, right = cls.judge(exercise), cls.right(exercise)
        slow = is_slow(judge)
        shows = {
            name: set(SHOWN.findall(text) if slow else SHOWN_WITH_HINT.findall(text))
            for name, text in page(cls.topic(), exercise).items()
        }
        names, left = right[: 1 if slow else None], set().union(*shows.values())
        while left:
            names.append(max(shows, key=lambda name: len(shows[name] & left)))
            left -= shows[names[-1]]
        return names[: 3 if simulated(judge) >= LONGEST else None]

    @classmethod
    def row(cls, exercise: str, node: str) -> Any:
        """A node's place in the table, with the marks that say when it is run."""
        first, reported = cls.right(exercise)[:1], page(cls.topic(), exercise).get(node, "")
        marks = [] if node in cls.daily(exercise) else [pytest.mark.soak]
        marks += [pytest.mark.pythons] if node in first or RAISED.search(reported) else []
        return pytest.param(exercise, node, marks=marks)

    @pytest.fixture
    def program(self, exercise, node, monkeypatch) -> Any:
        """A student's program, whose runs are made once."""
        evidence = Evidence.of_nodes(self.topic())
        monkeypatch.setattr("sim.run", evidence.keeping(f"{exercise}-{node}"))
        return students(self.topic(), exercise)[node]

    def test_a_node_earns_its_points_and_words(self, exercise, node, program):
        """In its first run, or else in all of them; `make solutions` has all runs of a right one."""
        judge = self.judge(exercise)
        score = first_run(judge).grade(*programs_of(program))
        if shown(node, score) != page(self.topic(), exercise).get(node):
            score = judge.grade(*programs_of(program))
        self.check_words(exercise, node, score)

    @pytest.mark.soak
    def test_no_run_shows_more_than_a_page_says(self, exercise, node, program):
        self.check_words(exercise, node, self.judge(exercise).grade(*programs_of(program)))

    def check_words(self, exercise: str, node: str, score: Score) -> None:
        """It is what the page says; and the first look finds no error in a right node that starts."""
        assert shown(node, score) == page(self.topic(), exercise).get(node)
        assert score.broken == []
        if node in self.right(exercise):
            started = [run for run in score.recordings if f"/{REFUSED}" not in run.graph.nodes]
            assert {find_flaw(recording) for recording in started} == {""}

    @pytest.mark.soak
    def test_right_nodes_earn_everything_with_every_students_seeds(self, exercise):
        (least, most), judge = PRIVATE, self.judge(exercise)
        number = least if judge.package else min(max(int(PRIVATE_SECONDS / simulated(judge)), least), most)
        assert list(fallen_short(self.topic(), exercise, range(number), SOLUTION)) == []
        assert list(fallen_short(self.topic(), exercise, range(number, number + least))) == []

    @pytest.mark.soak
    def test_right_nodes_earn_everything_in_every_order(self, exercise):
        number = ORDERS_OF_PACKAGES if self.judge(exercise).package else ORDERS
        numbers = range(1, number + 1)
        assert list(fallen_short_in_orders(self.topic(), exercise, numbers)) == []

    def test_a_right_node_that_works_only_at_times_breaks_no_check(self, exercise, times):
        """It misses what it doesn't do; a check that then finds nothing to judge isn't broken."""
        judge, nodes = first_run(self.judge(exercise)), students(self.topic(), exercise)
        seconds = max(scenario.seconds for scenario, _ in judge.runs())
        programs = [working(nodes[name], times, seconds) for name in self.right(exercise)]
        program = next(filter(None, programs), None)
        if program is None:
            return  # its right answers are whole programs, whose spinning can't be held up
        score = judge.grade(*programs_of(program))
        assert score.broken == []
        assert times != "never" or score < judge.points

    def test_a_page_speaks_of_every_student_of_its_exercise(self, exercise):
        assert list(page(self.topic(), exercise)) == list(students(self.topic(), exercise))

    def test_a_right_node_has_a_design_that_neither_the_lesson_nor_the_solution_shows(self, exercise):
        source = (folder_of(self.topic(), exercise) / "students.py").read_text(encoding="utf-8")
        if self.folder >= FIRST_WITH_DESIGNS:
            assert {first or second for first, second in DESIGN.findall(source)} & set(self.right(exercise))

    def test_a_page_has_three_right_nodes_six_wrong_ones_and_every_sentence(self, exercise):
        blocks = page(self.topic(), exercise).values()
        assert len(self.right(exercise)) >= 3
        assert len(blocks) - len(self.right(exercise)) >= 6
        missed = {line[2:] for block in blocks for line in block.splitlines() if line.startswith("- ")}
        assert {check.sentence for check in self.judge(exercise).checks} <= missed

    def test_the_starter_earns_nothing_and_has_a_kind_message(self):
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
        cells = graded("exercises", self.folder).values()  # the solution's test cells
        offered = [exercise_of(cell, self.package) for cell in cells]
        assert offered == [self.judge(name) for name in self.names]
        assert [exercise.points for exercise in offered] == [cell.most for cell in cells]
