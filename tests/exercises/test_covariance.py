"""Score tables of 14b_covariance: a page for each exercise in tests/exercises/covariance/."""

from grader.exercises import covariance
from tests.exercises.assignment import Assignment


class TestCovariance(Assignment):
    folder = "14b_covariance"
    package = covariance
