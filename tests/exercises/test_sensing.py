"""Score tables of 05_sensing: a page for each exercise in tests/exercises/sensing/."""

from grader.exercises import sensing
from tests.exercises.assignment import Assignment


class TestSensing(Assignment):
    folder = "05_sensing"
    package = sensing
