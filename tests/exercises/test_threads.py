"""Score tables of 15b_threads: a page for each exercise in tests/exercises/threads/."""

from grader.exercises import threads
from tests.exercises.assignment import Assignment


class TestThreads(Assignment):
    folder = "15b_threads"
    package = threads
