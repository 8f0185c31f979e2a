"""Score tables of 08b_drawing: a page for each exercise in tests/exercises/drawing/."""

from grader.exercises import drawing
from tests.exercises.assignment import Assignment


class TestDrawing(Assignment):
    folder = "08b_drawing"
    package = drawing
