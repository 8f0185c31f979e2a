"""Score tables of 13_warehouse: a page for each exercise in tests/exercises/warehouse/."""

from grader.exercises import warehouse
from tests.exercises.assignment import Assignment


class TestWarehouse(Assignment):
    folder = "13_warehouse"
    package = warehouse
