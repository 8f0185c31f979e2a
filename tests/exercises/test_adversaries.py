"""The general adversary: in every exercise, who doesn't do the work gets what is given for being there."""

import itertools
import math

import pytest

from grader.cast import LocalCast
from grader.catalogue import exercises
from tests.exercises.adversaries import KINDS, adversary
from tests.exercises.assignment import Assignment, first_run, is_long
from tests.exercises.at_times import spun_until
from tests.exercises.cards import Card
from tests.exercises.evidence import Evidence
from tests.exercises.score_tables import students
from tests.exercises.test_actions import TestActions as Actions
from tests.exercises.test_control import TestControl as Control
from tests.exercises.test_delivery import TestDelivery as Delivery
from tests.exercises.test_frames import TestFrames as Frames
from tests.exercises.test_joints import TestJoints as Joints
from tests.exercises.test_navigator import TestNavigator as Navigator
from tests.exercises.test_nodes import TestNodes as Nodes
from tests.exercises.test_packages import TestPackages as Packages
from tests.exercises.test_safety import TestSafety as Safety
from tests.exercises.test_sensing import TestSensing as Sensing
from tests.exercises.test_services import TestServices as Services
from tests.exercises.test_silence import TestSilence as Silence
from tests.exercises.test_topics import TestTopics as Topics
from tests.students.teams import programs_of

ASSIGNMENTS: tuple[type[Assignment], ...] = (
    *(Nodes, Topics, Services, Actions, Sensing, Navigator, Silence),
    *(Joints, Frames, Control, Packages, Safety, Delivery),
)
ALL = [(assignment, name) for assignment in ASSIGNMENTS for name in assignment.names]
SECRET = "an instructor's"
ALL_KINDS = (*KINDS, "ends early")
EARLY, AT_ONCE = 0.3, 0.1  # of the time; where a program may end when it is done, it has to end sooner
# Where the task says all: nothing varies, and nothing is to be sensed. Who gives that by the clock is right,
# but who says everything is not; save where a part of what is said is right: of an IMU, and of a square.
FIXED = {(Nodes, name) for name in Nodes.names}
FIXED |= {(Topics, name) for name in ("greeting", "temperature", "imu", "remapping", "square")}
FIXED |= {(Joints, "seven")}


def for_being_there(exercise):
    """Points of the checks that build on no other: that a node, its topics, its services are there."""
    return sum(check.points for check in exercise.checks if not check.after)


def rows(kinds):
    return [
        pytest.param(
            assignment,
            name,
            kind,
            id=f"{assignment.topic()}-{name}-{kind.replace(' ', '_')}",
            marks=[pytest.mark.soak] if is_long(assignment.judge(name)) else [],
        )
        for assignment, name in ALL
        for kind in kinds
        if kind in wrong_in(assignment, name)
    ]


def wrong_in(assignment, name):
    """The kinds that do not what the exercise asks for."""
    if (assignment, name) == (Nodes, "hello"):
        return ["does nothing", "says everything"]  # it is done at once
    if (assignment, name) in ((Topics, "imu"), (Topics, "square"), (Silence, "pub")):
        return ["does nothing", "ends early"]
    return ["does nothing", "says everything", "ends early"] if (assignment, name) in FIXED else ALL_KINDS


def card_of(assignment, name, monkeypatch):
    """The public run of a right node; made once."""
    right, evidence = assignment.right(name)[0], Evidence.of_nodes(assignment.topic())
    with monkeypatch.context() as patched:
        patched.setattr("sim.run", evidence.keeping(f"{name}-{right}"))
        judge = first_run(assignment.judge(name))
        return Card(judge.grade(*programs_of(students(assignment.topic(), name)[right])).recordings[0])


def done_at(run):
    """When the robot stood still for good, or the run ended."""
    moved = [after.stamp for before, after in itertools.pairwise(run.path) if before[1:] != after[1:]]
    return moved[-1] if moved else run.ended.stamp


def earned(exercise, program):
    score = first_run(exercise).judge(LocalCast(programs_of(program)), SECRET)
    assert score.broken == []
    return score


def test_every_exercise_of_the_course_is_tried():
    assert {assignment.judge(name) for assignment, name in ALL} == set(exercises().values())


@pytest.mark.parametrize(("assignment", "name", "kind"), rows(KINDS))
def test_who_knows_only_the_card_gets_what_is_given_for_being_there(assignment, name, kind, monkeypatch):
    exercise = assignment.judge(name)
    score = earned(exercise, adversary(kind, card_of(assignment, name, monkeypatch)))
    assert score <= for_being_there(exercise), score.text


@pytest.mark.parametrize(("assignment", "name", "kind"), rows(["ends early"]))
def test_what_was_not_run_is_not_earned(assignment, name, kind, monkeypatch):
    exercise, nodes = assignment.judge(name), students(assignment.topic(), name)
    part = AT_ONCE if exercise.may_end else EARLY
    seconds = part * done_at(card_of(assignment, name, monkeypatch).run)
    programs = [spun_until(nodes[right], seconds) for right in assignment.right(name)]
    program = next(filter(None, programs), None)
    if program is None:
        return  # its right answers are whole programs, which end when they like
    score, there = earned(exercise, program), for_being_there(exercise)
    assert score <= there + math.ceil(2 * part * (exercise.points - there)) / 2, score.text
