"""Score tables of 14c_localization: a page for each exercise in tests/exercises/localization/."""

from grader.exercises import localization
from tests.exercises.assignment import Assignment


class TestLocalization(Assignment):
    folder = "14c_localization"
    package = localization
