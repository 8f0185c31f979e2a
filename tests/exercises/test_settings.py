"""Score tables of 03b_settings: a page for each exercise in tests/exercises/settings/."""

from grader.exercises import settings
from tests.exercises.assignment import Assignment


class TestSettings(Assignment):
    folder = "03b_settings"
    package = settings
