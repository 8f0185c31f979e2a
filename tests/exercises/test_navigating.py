"""Score tables of 06b_navigating: a page for each exercise in tests/exercises/navigating/."""

from grader.exercises import navigating
from tests.exercises.assignment import Assignment


class TestNavigating(Assignment):
    folder = "06b_navigating"
    package = navigating
