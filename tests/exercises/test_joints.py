"""Score tables of 08_joints: a page for each exercise in tests/exercises/joints/."""

from grader.exercises import joints
from tests.exercises.assignment import Assignment


class TestJoints(Assignment):
    folder = "08_joints"
    package = joints
