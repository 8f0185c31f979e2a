"""A typo of a number's type or of a name costs half of what the program would have earned."""

import functools

import pytest
from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_msgs.msg import Float32, Float64, Int32

from grader import Exercise, grade
from grader.checks import keeps_clear, publishes, rate, within
from grader.diagnosis.names import misspelt
from grader.exercise import Scenario
from grader.programs import RemotePrograms
from grader.typos import CORRECTED_HINT, auto_correct, typos_of
from sim import Process, Recording
from sim.evidence import CallbackError, Endpoint, Graph
from sim.ros.launching.respawned import respawned
from tests.exercises.score_tables import students
from tests.sim.ros.remote.follower_process import FollowerProcess

warm = Exercise("warm", "A thermometer", seconds=5)


@warm.check(4)
def is_published(run):
    """It is published."""
    publishes(run, "/sensor/warm", "std_msgs/msg/Float32")


@warm.check(4, after=is_published)
def once_a_second(run):
    """It comes once a second."""
    rate(run, "/sensor/warm", 1.0)


@warm.check(4, after=is_published)
def is_warm(run):
    """It is warm."""
    within(run, "/sensor/warm", "data", 20.0, 25.0)


class Warm(Node):
    topic, value, type = "/sensor/warm", 20.0, Float32

    def __init__(self):
        super().__init__("warm")
        self.publisher = self.create_publisher(self.type, self.topic, 10)
        self.create_timer(1.0, self.tell)

    def tell(self):
        self.publisher.publish(self.type(data=self.value))


class WholeNumber(Warm):
    value = 20


class WholeAndCold(Warm):
    value = 10


class Misspelt(Warm):
    topic = "/sensor/wram"


class MisspeltAndWhole(Misspelt):
    value = 20


class AnotherType(Warm):
    type, value = Int32, 20


class Double(Warm):
    type = Float64


class DoubleAndCold(Double):
    value = -1e300


class DoubleAndWhole(Double):
    value = 20


class DoubleAndMisspelt(Double):
    topic = "/sensor/wram"


class DoubleMisspeltAndWhole(DoubleAndMisspelt):
    value = 20


class Text(Warm):
    value = "20"


@pytest.mark.parametrize(
    ("student", "points"),
    [
        (Warm, 12.0), (WholeNumber, 6.0), (WholeAndCold, 4.0), (Misspelt, 6.0), (MisspeltAndWhole, 6.0),
        (Double, 6.0), (DoubleAndCold, 4.0), (DoubleAndWhole, 6.0), (DoubleAndMisspelt, 6.0), (DoubleMisspeltAndWhole, 6.0), (AnotherType, 0.0), (Text, 0.0), (Process(WholeNumber), 6.0), (lambda: WholeNumber(), 6.0),
    ],
)  # fmt: skip
def test_a_typo_costs_half(student, points):
    score = warm.grade(student)
    assert score.broken == []
    assert float(score) == points


def test_the_typo_is_reported_and_what_would_have_been_right_says_why_it_has_half():
    *_, pace, value = warm.grade(Misspelt).verdicts
    assert [(it.status, it.credit, it.hint) for it in (pace, value)] == [("skipped", 0.5, CORRECTED_HINT)] * 2
    assert CORRECTED_HINT == "Graded as if the typo above were fixed, for half of the points."
    assert (
        warm.grade(Misspelt).verdicts[0].hint == "Is /sensor/wram a typo? Did you mean /sensor/warm?"
    )


def test_a_name_by_which_nothing_is_received_is_a_typo_and_another_namespace_or_a_pair_of_the_course_is_none():
    def end(kind, name, own):
        return Endpoint(kind, "/a", name, "std_msgs/msg/Bool", {}, own)

    own = [
        end("publisher", "/scan", True),
        end("publisher", "/bumper", True),
        end("service", "/reset", True),
    ]
    other = ("/scna", "/left/scan", "/bumper", "/rosuot")
    ends = [*own, *(end("subscription", name, False) for name in other), end("client", "/rest", False)]
    recording = Recording(graph=Graph(endpoints=[*ends, end("publisher", "/rosout", True)]))
    assert misspelt(recording) == [("/rest", "/reset"), ("/scna", "/scan")]
    assert misspelt(Recording(graph=Graph(endpoints=[*ends, end("subscription", "/scan", True)]))) == [
        ("/rest", "/reset")
    ]


def test_only_numbers_of_the_other_kind_and_names_are_typos():
    def failing(text, type="AssertionError"):
        return Recording(errors=[CallbackError(1.0, "/a", "A.b", type, text, "")])

    assert typos_of(failing("The 'data' field must be of type 'float'"), []) == ["numbers"]
    assert typos_of(failing("The 'data' field must be of type 'int'"), []) == ["numbers"]
    assert typos_of(failing("The 'data' field must be of type 'str'"), []) == []
    assert typos_of(failing("The 'data' field must be of type 'int'", "ValueError"), []) == []


@pytest.mark.parametrize(
    ("assignment", "exercise", "student"),
    [
        ("services", "add", "MisspeltService"),
        ("nodes", "counter", "OtherName"),
        ("actions", "fibonacci", "MisspeltName"),
        ("sensing", "stop", "MisspeltScan"),
        ("settings", "parameters", "ParameterMisspeltEverywhere"),
    ],
)
def test_names_of_services_nodes_actions_and_parameters_can_be_fixed_too(assignment, exercise, student):
    score = grade(exercise, students(assignment, exercise)[student])
    missed = next(verdict for verdict in score.verdicts if verdict.status == "failed")
    assert missed.earned == missed.points / 2


killed = Exercise(
    "killed",
    "A thermometer that is killed and started again",
    checks=[is_published, is_warm],
    scenarios=[Scenario(seconds=9, prepare=functools.partial(respawned, 3.0, 4.0, 0.5))],
)


@pytest.mark.parametrize(
    ("student", "points"),
    [(Warm, 8.0), (WholeNumber, 4.0), (MisspeltAndWhole, 4.0), (WholeAndCold, 2.0), (Text, 0.0)],
)
def test_a_typo_costs_half_in_what_a_scenario_makes_of_a_program_too(student, points):
    assert float(killed.grade(student)) == points


def test_it_does_so_where_the_program_lives_in_another_process():
    follower = FollowerProcess()
    with follower.serving(__name__, "MisspeltAndWhole") as remote:
        score = killed.judge(RemotePrograms(remote))
    follower.close()
    assert (score.broken, float(score)) == ([], 4.0)


def twice(program):
    """Two robots with the same program."""
    return [program, program]


def test_several_programs_that_a_scenario_makes_of_one_are_fixed_each():
    both = auto_correct(Warm, [f"{__name__}:twice"], "numbers")
    assert [(one.target, one.lenient) for one in both] == [(Warm, True)] * 2


def test_a_launch_file_has_no_typos_that_are_fixed():
    assert auto_correct(None, ["grader.workspace.installation:ros2_launch", "patrol", "patrol.launch.py"], "a:=b") == (
        "patrol patrol.launch.py"
    )


def test_who_is_unsafe_without_a_typo_is_unsafe():
    drive = Exercise("drives", "A driver", world="room", seconds=20)

    @drive.check(8)
    def goes(run):
        """It goes."""
        publishes(run, "/cmd_vel", at_least=5)

    @drive.check(2, after=goes)
    def touches_nothing(run):
        """It touches nothing."""
        keeps_clear(run)

    score = drive.grade(WholeSpeed)
    assert (float(score), score.verdicts[-1].unsafe) == (4.0, True)


class WholeSpeed(Node):
    def __init__(self):
        super().__init__("fast")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, self.drive)

    def drive(self):
        msg = Twist()
        msg.linear.x = 1
        self.publisher.publish(msg)
