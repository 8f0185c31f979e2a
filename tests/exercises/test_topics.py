"""Score tables of 02_topics: a page for each exercise in tests/exercises/topics/."""

from grader.exercises import topics
from tests.exercises.assignment import Assignment


class TestTopics(Assignment):
    folder = "02_topics"
    package = topics
