"""Score tables of 07_silence: a page for each exercise in tests/exercises/silence/."""

from grader.exercises import silence
from tests.exercises.assignment import Assignment


class TestSilence(Assignment):
    folder = "07_silence"
    package = silence
