"""Score tables of 13_delivery: a page for each exercise in tests/exercises/delivery/."""

from grader.exercises import delivery
from tests.exercises.assignment import Assignment


class TestDelivery(Assignment):
    folder = "13_delivery"
    package = delivery
