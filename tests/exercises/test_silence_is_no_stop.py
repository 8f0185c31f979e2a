"""Silence is not a stop: a right node that sends nothing in place of zeros loses points everywhere."""

import pytest
from geometry_msgs.msg import Twist
from rclpy.publisher import Publisher

from grader.programs import LocalPrograms
from sim.ros.fibers.scheduler import engine
from tests.exercises.assignment import is_long
from tests.exercises.score_tables import students
from tests.exercises.seeds import right_nodes
from tests.exercises.test_adversaries import ALL
from tests.students.teams import programs_of

# The right node sends zeros, and no check could ask for them.
NOT_THE_STUDENTS = {
    "convoy": "the program that drives is given, and creeps up to its place",
    "watch": "the program that turns the tower is given",
    "blueprint": "a plan of programs: what they send is made up by the course",
}
ROWS = [
    pytest.param(assignment, name, id=f"{assignment.topic()}-{name}",
                 marks=[pytest.mark.soak] if is_long(assignment.judge(name)) else [])
    for assignment, name in ALL
    if any(scenario.world is not None for scenario, _ in assignment.judge(name).runs())
]  # fmt: skip


@pytest.fixture
def dropped(monkeypatch):
    """The messages of zeros that the student's programs try to publish, and don't."""
    found, publish = [], Publisher.publish

    def without_zeros(self, msg):
        twist, run = getattr(msg, "twist", msg), engine()
        is_students = run is not None and not run.recorder.is_course_node()
        if is_students and isinstance(twist, Twist) and not (twist.linear.x or twist.angular.z):
            found.append(msg)
        else:
            publish(self, msg)

    monkeypatch.setattr(Publisher, "publish", without_zeros)
    return found


@pytest.mark.parametrize(("assignment", "name"), ROWS)
def test_silence_in_place_of_zeros_costs_points(assignment, name, dropped):
    exercise, right = assignment.judge(name), right_nodes(assignment.topic(), name)[0]
    score = exercise.judge(LocalPrograms(programs_of(students(assignment.topic(), name)[right])))
    if name in NOT_THE_STUDENTS:
        assert dropped, "it sends no zeros: leave it out of the list"
    elif dropped:
        assert score < exercise.points, score.text
