"""Score tables of 15c_systems: a page for each exercise in tests/exercises/systems/."""

from grader.exercises import systems
from tests.exercises.assignment import Assignment


class TestSystems(Assignment):
    folder = "15c_systems"
    package = systems
