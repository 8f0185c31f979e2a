"""Score tables of 14b_localization: a page for each exercise in tests/exercises/localization/."""

from grader.exercises import localization
from tests.exercises.assignment import Assignment


class TestLocalization(Assignment):
    folder = "14b_localization"
    package = localization
