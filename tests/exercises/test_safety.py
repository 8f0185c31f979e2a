"""Score tables of 12_safety: a page for each exercise in tests/exercises/safety/."""

from grader.exercises import safety
from tests.exercises.assignment import Assignment


class TestSafety(Assignment):
    folder = "12_safety"
    package = safety
