import sys
from dataclasses import replace
from functools import partial

import pytest
import rclpy
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import Float32, Float64, String

from grader import Exercise, Missed, Scenario, Score, check
from grader.checks import publishes, rate
from grader.grading import Grading, graded_as
from grader.programs import LocalPrograms
from grader.seeds import private_seed
from grader.workspace.building import Built
from grader.workspace.package import Package
from grader.workspace.package_xml import PackageXml
from sim import Network, Process, World
from tests.grader.test_orders import PairsByArrival, adds  # noqa: F401 (a fixture)
from tests.students import misfits, mistakes
from tests.students.engine import output

PACKAGE = Package({}, PackageXml("patrol", {}), Built())


@check(points=1)
def sends(recording):
    """The node sends text on /chatter."""
    publishes(recording, "/chatter", "std_msgs/msg/String")


@check(points=2, after=sends)
def paced(recording):
    """It sends once a second."""
    rate(recording, "/chatter", 1.0)


talk = Exercise("talk", "A talker", checks=[sends, paced])


def statuses(score):
    return {verdict.name: verdict.status for verdict in score.verdicts}


def red_line(score):
    (line,) = [verdict for verdict in score.verdicts if verdict.status == "failed"]
    return line.sentence, line.expected, line.saw, line.hint


def test_a_good_node_gets_full_marks():
    score = talk.grade(misfits.Talker)
    assert isinstance(score, Score)
    assert (score, score.max, talk.points, score.title) == (3.0, 3.0, 3.0, "A talker")
    assert score.recordings[0].seconds == 10.0


def test_what_an_exercise_does_not_say_is_not_so():
    plain = Exercise("plain", "Plain", checks=[sends])
    assert (plain.may_end, plain.names_count, plain.extra_allowed) == (False, False, False)
    ((scenario, seed),) = plain.runs()
    assert (scenario.seed, seed, scenario.network) == (0, 0, None)
    assert not plain.check(1)(unnamed).lasts
    assert plain.check(1, lasts=True)(documented).lasts


def test_the_one_scenario_of_an_exercise_has_its_network():
    network = Network(loss=0.5)
    assert [scenario.network for scenario, _ in Exercise("far", "Far", network=network).runs()] == [network]


def documented(run):
    """A sentence."""


@pytest.mark.parametrize(
    ("settings", "varies"),
    [
        ({}, False),
        ({"world": "room"}, False),
        ({"seeds": (1, 2)}, True),
        ({"seeds": (2,)}, False),
        ({"companions": [misfits.Talker]}, True),
        ({"world": lambda seed: World.load("room")}, True),
        ({"package": "patrol"}, True),
        ({"scenarios": [Scenario(seconds=1), Scenario(seconds=2)]}, False),
        ({"scenarios": [Scenario(seed=1), Scenario(seed=2)]}, True),
        ({"scenarios": [Scenario(), Scenario(companions=[misfits.Talker])]}, True),
    ],
)
def test_an_exercise_varies_where_the_right_answer_is_not_in_the_text_of_its_task(settings, varies):
    assert Exercise("one", "One", **settings).varies is varies


def test_where_another_process_judges_the_nodes_are_handed_over():
    given = []
    with graded_as(Grading(hand_over=lambda name, nodes: given.append((name, nodes)) or "handed over")):
        assert talk.grade(misfits.Talker, None) == "handed over"
    assert given == [("talk", (misfits.Talker, None))]


class Source(LocalPrograms):
    """Programs of a workspace that is built already."""

    installed = PACKAGE

    def __init__(self, *nodes):
        super().__init__(nodes)
        self.left = 0

    def package(self, name, build_type, uses=None, corrections=()):
        self.asked = name, build_type
        return None if corrections else self.installed

    def leave(self):
        self.left += 1


def test_what_was_installed_is_removed_after_the_runs_whatever_happened():
    for exercise in (talk, Exercise("talk", "A talker", checks=[sends], world="rom")):
        source = Source(misfits.Talker)
        exercise.judge(source)
        assert source.left == 1


def test_checks_are_given_the_package_of_the_run():
    building = Exercise("patrol", "A patrol", package="patrol", build_type="ament_cmake", seconds=0)
    seen = []

    @building.check(1)
    def is_built(run):
        """It is built."""
        seen.append(run.package)

    source = Source()
    assert building.judge(source) == 1.0
    assert (seen, source.asked) == ([PACKAGE], ("patrol", "ament_cmake"))


def main_that_ends(topic="/chatter"):
    """Publishes once a second until 3 s, and ends."""
    rclpy.init()
    node = Node("brief")
    publisher = node.create_publisher(String, topic, 10)
    node.create_timer(1.0, lambda: publisher.publish(String()))
    end = Future()
    node.create_timer(3.5, lambda: end.set_result(None))
    rclpy.spin_until_future_complete(node, end)
    node.destroy_node()


@pytest.mark.parametrize(
    ("main", "may_end", "points"),
    [
        (main_that_ends, True, 4.0),
        (main_that_ends, False, 1.0),  # 3.5 of 10 s of it, rounded down
        (partial(main_that_ends, "/chater"), True, 2.0),
        (partial(main_that_ends, "/chater"), False, 0.5),
    ],
)
def test_a_program_that_ends_has_all_points_where_it_may_and_half_of_them_with_a_typo(main, may_end, points):
    brief = Exercise("brief", "A program that ends", may_end=may_end)

    @brief.check(4, lasts=True)
    def sends_something(run):
        """It sends something."""
        publishes(run, "/chatter", "std_msgs/msg/String")

    assert brief.grade(main) == points


class Numbers(Node):
    """Publishes numbers of another type, on a topic whose name is misspelt."""

    topic, type = "/numbres", Float64

    def __init__(self):
        super().__init__("numbers")
        self.publisher = self.create_publisher(self.type, self.topic, 10)
        self.create_timer(1.0, lambda: self.publisher.publish(self.type(data=1.0)))


class OfAnotherType(Numbers):
    topic = "/numbers"


class Misspelt(Numbers):
    type = Float32


class Right(Misspelt):
    topic = "/numbers"


@pytest.mark.parametrize(
    ("student", "points"), [(Right, 2.0), (Numbers, 1.0), (OfAnotherType, 1.0), (Misspelt, 1.0)]
)
def test_a_program_with_typos_has_half_of_what_it_earns_without_them(student, points):
    counting = Exercise("numbers", "Numbers", seconds=3)

    @counting.check(2)
    def sends_numbers(run):
        """It sends numbers."""
        publishes(run, "/numbers", "std_msgs/msg/Float32", at_least=2)

    score = counting.grade(student)
    assert (score, score.broken) == (points, [])
    sent = [row.topic for row in score.recordings[0].published if row.topic != "/parameter_events"]
    assert set(sent) == {student.topic}  # what is shown is the run of the program as it is


@pytest.mark.parametrize(
    "student, points",
    [
        (misfits.SilentTalker, 0.0),
        (misfits.SleepyTalker, 1.0),
        (mistakes.DividesByZero, 0.0),
        (mistakes.NotStarted, 0.0),
        (misfits.main_that_never_ends, 0.0),
        (misfits.main_without_spin, 0.0),
        (misfits.Echo, 1.0),
    ],
)
def test_a_wrong_node_gets_what_it_earned_and_one_red_line(student, points):
    score = talk.grade(student)
    assert score == points
    assert len([v for v in score.verdicts if v.status == "failed"]) == 1


NO_CODE = ("There is code to run.", "your node's class, or your main function")


@pytest.mark.parametrize(
    "handed_over, saw, hint",
    [
        ((), "nothing", "Put the name of your class between the parentheses: grade(MyNode)."),
        ((None,), "None", "This exercise is not started yet: write your class in the cell above."),
        (
            (misfits.Talker, None),
            "None",
            "This exercise is not started yet: write your class in the cell above.",
        ),
        ((Process(None),), "None", "This exercise is not started yet: write your class in the cell above."),
        ((dict,), "the class dict, which is not a Node", "Begin the class with `class dict(Node):`."),
        (
            ("Talker",),
            "'Talker', which is not a node",
            "Give the class itself, by its name and without quotes.",
        ),
        ((42,), "42, which is not a node", "Give the class itself, by its name and without quotes."),
        (
            (Process(misfits.Talker, remappings=["chatter:=news"]),),
            "remappings=['chatter:=news']",
            'Remappings are a list of pairs of names: remappings=[("from", "to")].',
        ),
    ],
)
def test_what_cannot_be_run_gets_0_and_a_kind_word(handed_over, saw, hint):
    score = talk.grade(*handed_over)
    assert score == 0.0
    assert red_line(score) == (*NO_CODE, saw, hint)
    assert statuses(score) == {"runs": "failed", "sends": "skipped", "paced": "skipped"}


class Secretive(type(Node)):
    """Its classes answer no question about themselves."""

    def __getattribute__(cls, name):
        if name in ("__name__", "__module__", "__globals__"):
            raise ValueError(name)
        return super().__getattribute__(name)


class Unnameable(Node, metaclass=Secretive):
    pass


class Evasive:
    def __getattr__(self, name):
        raise RuntimeError(name)

    def __call__(self):
        pass


def test_a_class_that_can_not_be_looked_at_gets_0():
    score = talk.grade(Unnameable)
    assert score == 0.0
    assert red_line(score) == (
        *NO_CODE,
        "something that raises ValueError when it is inspected",
        "Give an ordinary class that is based on Node.",
    )


@pytest.mark.parametrize(
    "student",
    [
        Evasive(),
        Process(misfits.Talker, parameters="rate"),
        Process(misfits.Talker, arguments=5),
        Process(misfits.Talker, name="two words"),
    ],
    ids=["evasive", "parameters", "arguments", "name"],
)
def test_settings_that_can_not_be_read_are_the_students_error_not_the_course(student):
    score = talk.grade(student)
    assert score == 0.0
    assert statuses(score) == {"runs": "failed", "sends": "skipped", "paced": "skipped"}


def test_parameters_may_be_a_list_as_in_a_launch_file():
    assert talk.grade(Process(misfits.Talker, parameters=[{"rate": 1.0}, {"word": "hi"}])) == 3.0


def test_an_object_in_place_of_its_class_is_reported():
    node = object.__new__(misfits.Talker)
    line = red_line(talk.grade(node))
    assert line == (
        *NO_CODE,
        "an object of Talker",
        "Leave out the parentheses after the name: Talker, not Talker().",
    )


def test_where_there_is_nothing_to_run_every_check_says_so():
    score = talk.grade(None)
    assert score.title == "A talker"
    assert [verdict.hint for verdict in score.verdicts[1:]] == ["Not graded: there is nothing to run."] * 2


def test_a_stub_gets_0_and_its_own_words():
    score = talk.grade(mistakes.NotStarted)
    assert score == 0.0
    assert red_line(score)[2] == "This exercise is not started yet: publish a count once a second"


@pytest.mark.parametrize("make", [lambda: misfits.Talker(), partial(misfits.Talker)])
def test_whatever_gives_a_node_can_be_graded(make):
    assert talk.grade(make) == 3.0


def test_nothing_reaches_stderr_whatever_the_node_writes(capfd):
    for student in (output.writes_everywhere, output.logs_at_every_level, output.runs_a_program):
        talk.grade(student)
    assert capfd.readouterr().err == ""


@check(points=2)
def mistaken(recording):
    """It has a mistake of the course, and complains."""
    print("to be taken back", file=sys.stderr)
    return recording.no_such_thing


def test_a_mistake_of_the_course_is_flagged(capfd):
    score = Exercise("talk", "A talker", checks=[sends, mistaken]).grade(misfits.Talker)
    assert (score, statuses(score)) == (1.0, {"sends": "passed", "mistaken": "broken"})
    assert [verdict.name for verdict in score.broken] == ["mistaken"]
    said = capfd.readouterr()
    assert (said.out, said.err) == ("to be taken back\n\n", "")


class BreaksDown:
    """A program of the course that fails, in the second of two runs."""

    def __call__(self, seed):
        if seed == 2:
            raise RuntimeError("to be taken back")
        return []


def test_a_run_that_we_fail_in_has_only_broken_checks_and_shows_its_seed():
    scenarios = [Scenario(seconds=1, seed=1, name="quiet"), Scenario(seconds=1, seed=2, name="loud")]
    scenarios = [replace(scenario, companions=BreaksDown()) for scenario in scenarios]
    both = Exercise("both", "Two runs", scenarios=scenarios)
    both.check(1, only="quiet")(documented)
    both.check(1, only="loud")(starts)
    score = both.grade(misfits.Talker)
    assert (score, statuses(score)) == (1.0, {"documented": "passed", "starts": "broken"})
    assert [recording.seed for recording in score.recordings] == [1, 2]


def starts(run):
    """It starts."""


@pytest.fixture
def lucky():
    """Holds with three seeds of four."""
    exercise = Exercise("lucky", "Four runs", seeds=(1, 2, 3, 4), seconds=1)
    exercise.check(1)(starts)

    @exercise.check(1)
    def is_lucky(run):
        """It is lucky."""
        if run.seed == 3 and run.messages("/greeting"):
            raise Missed("luck", "none")

    return exercise


def test_in_an_order_the_run_is_shown_in_which_something_is_missed(lucky):
    recording, holds = lucky.in_order(partial(Greets, "/greeting"), order="k3f9")
    assert (recording.seed, recording.order, holds) == (3, "k3f9", False)


def test_in_an_order_in_which_nothing_is_missed_the_first_run_is_shown(lucky):
    for order, text in {0: "", 1: "1", "k3f9": "k3f9"}.items():
        recording, holds = lucky.in_order(partial(Greets, "/chatter"), order=order)
        assert (recording.seed, recording.order, holds) == (1, text, True)


def test_in_an_order_what_can_not_be_run_shows_an_empty_run(lucky):
    recording, holds = lucky.in_order(5, order=0)
    assert (recording.messages("/chatter"), holds) == ([], False)


class Greets(Node):
    def __init__(self, topic):
        super().__init__("greeter")
        self.publisher = self.create_publisher(String, topic, 10)
        self.create_timer(0.2, lambda: self.publisher.publish(String(data="hello")))


def test_what_is_missed_in_another_order_alone_has_its_own_difference_unless_the_order_is_private(adds):  # noqa: F811
    score = adds.grade(PairsByArrival)
    assert score == 0.0
    difference = score.differences[0]
    assert (difference.public, bool(difference.usual.departures), bool(difference.other.departures)) == (
        True,
        False,
        True,
    )
    private = adds.judge(LocalPrograms([PairsByArrival]), "a secret")
    assert [difference.public for difference in private.differences][:1] == [False]


@check(points=1)
def in_room(recording):
    """It does well in the room."""
    if recording.world.name == "room" and recording.seed == 2:
        raise Missed("a room", "a mess", "Tidy up.")


def test_a_check_holds_only_if_it_holds_in_all_scenarios():
    scenarios = [Scenario("yard", 1.0), Scenario("room", 2.0, seed=2)]
    tidy = Exercise("tidy", "Tidy up", checks=[in_room], scenarios=scenarios)
    score = tidy.grade(misfits.Talker)
    assert (score, score.verdicts[0].run) == (0.0, 1)
    assert [(r.world.name, r.seconds, r.seed) for r in score.recordings] == [
        ("yard", 1.0, 0),
        ("room", 2.0, 2),
    ]


def test_seeds_are_public_without_a_secret(monkeypatch):
    exercise = Exercise("talk", "A talker", checks=[sends], seeds=(1, 2), seconds=1)
    assert [seed for _, seed in exercise.runs()] == [1, 2]
    monkeypatch.setenv("COURSE_SECRET", "")
    assert [recording.seed for recording in exercise.grade(misfits.Talker).recordings] == [1, 2]


def test_seeds_are_derived_from_the_secret_where_there_is_one(monkeypatch):
    monkeypatch.setenv("COURSE_SECRET", "hush")
    exercise = Exercise("talk", "A talker", checks=[sends], seeds=(1, 2), seconds=1)
    seeds = [seed for _, seed in exercise.runs("hush")]
    # `printf 'talk 0' | openssl dgst -sha256 -hmac hush`, first 8 hex digits
    assert seeds[0] == 0xDE17FF43
    assert seeds == [private_seed("hush", "talk", 0), private_seed("hush", "talk", 1)]
    assert [recording.seed for recording in exercise.grade(misfits.Talker).recordings] == seeds
    others = {private_seed("hush!", "talk", 0), private_seed("hush", "tall", 0), *seeds}
    assert len(others) == 4


def test_where_some_seeds_alone_are_fair_a_student_gets_one_of_these():
    scenario = Scenario(seconds=1, seed=3, fair=(5, 6, 7))
    exercise = Exercise("talk", "A talker", checks=[sends], scenarios=[scenario])
    assert [seed for _, seed in exercise.runs()] == [3]
    assert {exercise.runs(f"secret {number}")[0][1] for number in range(40)} == {5, 6, 7}
    (seed,) = (seed for _, seed in exercise.runs("hush"))
    assert seed == (5, 6, 7)[private_seed("hush", "talk", 0) % 3]


@pytest.mark.parametrize(
    "changes, sentence",
    [
        ({"checks": [sends, sends]}, "exercise talk: two checks are called sends"),
        ({"checks": [paced, sends]}, "exercise talk: paced comes after sends, so list sends first"),
        ({"seeds": ()}, "exercise talk: give at least one seed"),
    ],
)
def test_an_exercise_that_cannot_work_is_refused(changes, sentence):
    with pytest.raises(ValueError) as caught:
        Exercise(**{"name": "talk", "title": "A talker", "checks": [sends], **changes})
    assert str(caught.value) == sentence


def test_an_exercise_without_points_judges_nothing():
    with pytest.raises(ValueError, match=r"^exercise talk: its checks have no points$"):
        Exercise("talk", "A talker").grade(misfits.Talker)


def test_declaring_a_check_registers_it_and_hands_on_what_was_measured():
    talking = Exercise("talk", "A talker")
    seen = []

    @talking.check(1)
    def sends_text(run):
        """The node sends text."""
        return publishes(run, "/chatter", "std_msgs/msg/String")

    @talking.check(2, after=sends_text)
    def says_hello(run, messages):
        """It says hello."""
        seen.append(len(messages))

    assert talking.checks == [sends_text, says_hello]
    assert talking.grade(misfits.Talker) == 3.0
    assert seen == [len(talking.grade(misfits.Talker).recordings[0].messages("/chatter"))] * 2


def test_a_check_that_missed_hands_on_only_what_it_says_it_measured():
    def exercise(**measured):
        talking = Exercise("talk", "A talker")

        @talking.check(2)
        def half(run):
            """Half of it."""
            raise Missed("all", "half", credit=0.5, **measured)

        @talking.check(1, after=half)
        def asks_for_more(run, found):
            """More of it."""
            assert found == "half"

        return talking

    assert statuses(exercise(measured="half").grade(misfits.Talker))["asks_for_more"] == "passed"
    assert (
        exercise()
        .grade(misfits.Talker)
        .broken[0]
        .alarm.endswith(
            "ValueError: half missed without saying what it measured: asks_for_more can't be judged\n"
        )
    )


def test_the_guess_stands_last_after_hint_and_diagnosis():
    guessing = Exercise("talk", "A talker")

    @guessing.check(1, guess="Perhaps the topic is another.")
    def receives_more(run):
        """It receives more."""
        raise Missed("more", "less")

    assert red_line(guessing.grade(misfits.Talker))[3] == "Perhaps the topic is another."
    assert "fired" in red_line(guessing.grade(misfits.SleepyTalker))[3]


def test_a_check_may_hold_in_some_scenarios_only():
    two = Exercise("two", "Two worlds", scenarios=[Scenario("yard", 1.0, name="wide"), Scenario("room", 1.0)])
    judged = []

    @two.check(1)
    def everywhere(run):
        """It holds everywhere."""
        judged.append(("everywhere", run.world.name))

    @two.check(1, only="wide", after=everywhere)
    def in_the_yard(run):
        """It holds in the yard."""
        judged.append(("in_the_yard", run.world.name))

    assert two.grade(misfits.Talker) == 2.0
    assert judged == [("everywhere", "yard"), ("in_the_yard", "yard"), ("everywhere", "room")]

    with pytest.raises(
        ValueError, match=r"^exercise two: asks receives what in_the_yard measures only in wide$"
    ):
        two.check(1, after=in_the_yard)(asks)
    wide = two.check(1, after=in_the_yard, only="wide")(asks)
    assert two.checks[-1] is wide
    with pytest.raises(
        ValueError, match=r"^exercise two: unnamed applies to 'narrow', which is not one of its scenarios$"
    ):
        two.check(1, only="narrow")(unnamed)


def test_a_check_is_handed_what_another_one_measured_in_the_same_scenarios_or_in_more():
    three = Exercise("three", "Three", scenarios=[Scenario(name=name) for name in ("one", "two", "three")])
    measures = three.check(1, only=("one", "two"))(unnamed)
    three.check(1, only="two", after=measures)(asks)
    three.check(1, only=("two", "one"), after=measures)(asks_again)
    match = r"^exercise three: asks_more receives what unnamed measures only in one, two$"
    for only in ((), "three", ("one", "three")):
        with pytest.raises(ValueError, match=match):
            three.check(1, only=only, after=measures)(asks_more)
    assert three.check(1, after=measures)(documented).after == (measures,)


def unnamed(run):
    """A sentence."""


def asks_again(run, measured):
    """It asks once more."""


def asks_more(run, measured):
    """It asks for more."""


def asks(run, measured):
    """It asks for what another check has measured."""


def test_a_check_waits_for_another_one_only_where_that_one_holds():
    two = Exercise("two", "Two worlds", scenarios=[Scenario("yard", 1.0, name="wide"), Scenario("room", 1.0)])
    judged = []

    @two.check(1, only="wide")
    def in_the_yard(run):
        """It holds in the yard."""
        raise Missed("all", "nothing")

    @two.check(1, after=in_the_yard)
    def everywhere(run):
        """It holds everywhere."""
        judged.append(run.world.name)

    assert statuses(two.grade(misfits.Talker)) == {"in_the_yard": "failed", "everywhere": "skipped"}
    assert judged == ["room"]
