"""Score tables of 10_control: a page for each exercise in tests/exercises/control/."""

from grader.exercises import control
from tests.exercises.assignment import Assignment


class TestControl(Assignment):
    folder = "10_control"
    package = control
