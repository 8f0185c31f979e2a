"""The general adversary: in every exercise, who doesn't do the work gets what is given for being there."""

import itertools
import math

import pytest

from grader.catalog import exercises
from tests.exercises.adversaries import KINDS, adversary
from tests.exercises.assignment import Assignment, is_slow
from tests.exercises.at_times import spun_until
from tests.exercises.chance import BY_LOT, card_of, earned, for_being_there
from tests.exercises.more_adversaries import LISTENS_ONCE, MORE_KINDS, hollow, more_adversary
from tests.exercises.score_tables import students
from tests.exercises.test_actions import TestActions as Actions
from tests.exercises.test_bags import TestBags as Bags
from tests.exercises.test_control import TestControl as Control
from tests.exercises.test_covariance import TestCovariance as Covariance
from tests.exercises.test_delivery import TestDelivery as Delivery
from tests.exercises.test_drawing import TestDrawing as Drawing
from tests.exercises.test_frames import TestFrames as Frames
from tests.exercises.test_guarding import TestGuarding as Guarding
from tests.exercises.test_joints import TestJoints as Joints
from tests.exercises.test_launching import TestLaunching as Launching
from tests.exercises.test_lifecycle import TestLifecycle as Lifecycle
from tests.exercises.test_localization import TestLocalization as Localization
from tests.exercises.test_navigating import TestNavigating as Navigating
from tests.exercises.test_navigator import TestNavigator as Navigator
from tests.exercises.test_nodes import TestNodes as Nodes
from tests.exercises.test_packages import TestPackages as Packages
from tests.exercises.test_races import TestRaces as Races
from tests.exercises.test_safety import TestSafety as Safety
from tests.exercises.test_sensing import TestSensing as Sensing
from tests.exercises.test_services import TestServices as Services
from tests.exercises.test_settings import TestSettings as Settings
from tests.exercises.test_silence import TestSilence as Silence
from tests.exercises.test_systems import TestSystems as Systems
from tests.exercises.test_testing import TestTesting as OwnTests
from tests.exercises.test_threads import TestThreads as Threads
from tests.exercises.test_topics import TestTopics as Topics
from tests.exercises.test_warehouse import TestWarehouse as Warehouse

ASSIGNMENTS: tuple[type[Assignment], ...] = (
    *(Nodes, Topics, Services, Settings, Actions, Sensing, Guarding, Navigator, Navigating, Silence),
    *(Joints, Drawing, Frames, Control, Packages, Launching, OwnTests, Safety, Lifecycle),
    *(Warehouse, Delivery, Bags, Covariance, Localization, Races, Threads, Systems),
)
ALL = [(assignment, name) for assignment in ASSIGNMENTS for name in assignment.names]
EVERY_DAY = {("lidar", LISTENS_ONCE), ("compass", LISTENS_ONCE), ("ticks", "asks everything"),
             ("chatters", "publishes everywhere")}  # fmt: skip
ALL_KINDS = (*KINDS, "ends early")
LUCK, NOTHING = 0.25, 0.3  # of the points that are left, and of all
EARLY, AT_ONCE = 0.3, 0.1  # of the time; where a program may end when it is done, it has to end sooner
# What is right without a stream of messages, or is in the task's text; the other points are beyond chance.
RIGHT_ANYWAY = {
    ("costmap", LISTENS_ONCE): 11,  # the map comes once; the clicks are a check of their own
    ("calibrate", LISTENS_ONCE): 7,  # with too few readings a refusal is right
    ("modes", LISTENS_ONCE): 7.5,  # modes and arming are services
    ("ticks", LISTENS_ONCE): 8,  # a timer asks, and answers go on
    ("trajectory", LISTENS_ONCE): 16,  # paths come seldom; where the arm is counts for one check
    ("audit", LISTENS_ONCE): 8,  # delays are data; only repaired systems receive a stream of messages
    ("customer", "asks everything"): 12,  # the goal is in the task's text, and with it its result
    ("courier", "asks everything"): 6,  # the same
    ("careful", "asks everything"): 6,  # what is wanted is passed on, and more
}
DONE_AT_ONCE = 3  # s: a program that may end in a run this short is done before it could end early


def rows(kinds):
    return [
        pytest.param(
            assignment,
            name,
            kind,
            id=f"{assignment.topic()}-{name}-{kind.replace(' ', '_')}",
            marks=[pytest.mark.soak] if is_slow(assignment.judge(name)) else [],
        )
        for assignment, name in ALL
        for kind in kinds
        if kind in wrong_in(assignment, name)
    ]


def wrong_in(assignment, name):
    """The kinds that are wrong in this exercise: all of them, unless the task's text says all that is right.

    Then a node that repeats a right answer by the clock is right, and so may be one that publishes more.
    """
    exercise = assignment.judge(name)
    kinds = list(ALL_KINDS) if exercise.varies else ["does nothing", "says everything", "ends early"]
    if exercise.extra_allowed:
        kinds.remove("says everything")
    if exercise.may_end and not any(scenario.seconds > DONE_AT_ONCE for scenario, _ in exercise.runs()):
        kinds.remove("ends early")
    return kinds


def done_at(run):
    """When the robot stood still for good, or the run ended."""
    moved = [after.stamp for before, after in itertools.pairwise(run.path) if before[1:] != after[1:]]
    return moved[-1] if moved else run.ended.stamp


def test_every_exercise_of_the_course_is_tried():
    assert {assignment.judge(name) for assignment, name in ALL} == set(exercises().values())
    assert [name for name in globals() if name.startswith("Test")] == [], "its tests would run here, too"


@pytest.mark.parametrize(("assignment", "name", "kind"), rows(KINDS))
def test_who_knows_only_the_card_gets_what_is_given_for_being_there(assignment, name, kind):
    exercise = assignment.judge(name)
    there, program = for_being_there(exercise), adversary(kind, card_of(assignment.topic(), name))
    score = earned(exercise, kind, program)
    assert score <= there + (LUCK * (exercise.points - there) if kind == BY_LOT else 0), score.text
    if kind == "does nothing" and not exercise.names_count:
        assert score <= NOTHING * exercise.points, score.text


MORE = [
    pytest.param(assignment, name, kind, id=f"{assignment.topic()}-{name}-{kind.replace(' ', '_')}",
                 marks=[] if (name, kind) in EVERY_DAY else [pytest.mark.soak])
    for assignment, name in ALL
    for kind in (*MORE_KINDS, LISTENS_ONCE)
    if assignment.judge(name).varies and not assignment.judge(name).package
]  # fmt: skip


@pytest.mark.parametrize(("assignment", "name", "kind"), MORE)
def test_who_publishes_or_asks_everything_or_listens_once_gets_no_more_than_chance(assignment, name, kind):
    exercise = assignment.judge(name)
    program = more_adversary(kind, assignment.topic(), name)
    if program is None:
        return  # its right answers have no stream of messages, or are whole programs
    there, score = for_being_there(exercise), earned(exercise, kind, program)
    chance = there + LUCK * (exercise.points - there)
    assert score <= max(chance, RIGHT_ANYWAY.get((exercise.name, kind), 0)), score.text


WITHOUT_A_FUNCTION = {"limiter": 6}  # its workflow is no function, and tests that do nothing pass
RIGHT_PACKAGES = {
    (each, name): students(each.topic(), name)[each.right(name)[0]]
    for each in (Packages, Launching, OwnTests)
    for name in each.names
}
HOLLOW = [
    pytest.param(assignment, name, workspace, id=name)
    for (assignment, name), right in RIGHT_PACKAGES.items()
    if (workspace := hollow(right)).files != right.files
]


@pytest.mark.soak  # each is built
@pytest.mark.parametrize(("assignment", "name", "workspace"), HOLLOW)
def test_a_package_whose_functions_do_nothing_earns_next_to_nothing(assignment, name, workspace):
    exercise = assignment.judge(name)
    score = earned(exercise, "", workspace)
    assert score <= WITHOUT_A_FUNCTION.get(name, NOTHING * exercise.points), score.text


@pytest.mark.parametrize(("assignment", "name", "kind"), rows(["ends early"]))
def test_what_was_not_run_is_not_earned(assignment, name, kind):
    exercise, nodes = assignment.judge(name), students(assignment.topic(), name)
    part = AT_ONCE if exercise.may_end else EARLY
    seconds = part * min(map(done_at, card_of(assignment.topic(), name).runs))
    programs = [spun_until(nodes[right], seconds) for right in assignment.right(name)]
    program = next(filter(None, programs), None)
    if program is None:
        return  # its right answers are whole programs, which end when they like
    score, there = earned(exercise, "ends early", program), for_being_there(exercise)
    assert score <= there + math.ceil(2 * part * (exercise.points - there)) / 2, score.text
