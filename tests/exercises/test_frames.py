"""Score tables of 09_frames: a page for each exercise in tests/exercises/frames/."""

from grader.exercises import frames
from tests.exercises.assignment import Assignment


class TestFrames(Assignment):
    folder = "09_frames"
    package = frames
