"""Score tables of 14_bags: a page for each exercise in tests/exercises/bags/."""

from grader.exercises import bags
from tests.exercises.assignment import Assignment


class TestBags(Assignment):
    folder = "14_bags"
    package = bags
