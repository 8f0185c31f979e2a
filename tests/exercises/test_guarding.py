"""Score tables of 05b_guarding: a page for each exercise in tests/exercises/guarding/."""

from grader.exercises import guarding
from tests.exercises.assignment import Assignment


class TestGuarding(Assignment):
    folder = "05b_guarding"
    package = guarding
