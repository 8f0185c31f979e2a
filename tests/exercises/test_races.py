"""Score tables of 15_races: a page for each exercise in tests/exercises/races/."""

from grader.exercises import races
from tests.exercises.assignment import Assignment


class TestRaces(Assignment):
    folder = "15_races"
    package = races
