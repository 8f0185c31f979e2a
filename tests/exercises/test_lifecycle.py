"""Score tables of 12b_lifecycle: a page for each exercise in tests/exercises/lifecycle/."""

from grader.exercises import lifecycle
from tests.exercises.assignment import Assignment


class TestLifecycle(Assignment):
    folder = "12b_lifecycle"
    package = lifecycle
