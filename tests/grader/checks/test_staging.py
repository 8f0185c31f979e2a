"""What a student's programs staged is no evidence."""

import dataclasses

import pytest
from nav_msgs.msg import Odometry
from rclpy.node import Node
from std_srvs.srv import Trigger

from grader import Exercise, Missed
from grader.checks import calls, publishes
from grader.checks.staging import LONGEST_LINE, evidence_of
from grader.diagnosis.owners import Intrusion, intrusions, two_owners
from sim import run
from sim.evidence import Call, LogLine
from tests.sim.recordings import recording
from tests.students.engine import actions


class Stager(Node):
    """Tells of a drive that there was not, and answers its own questions."""

    def __init__(self):
        super().__init__("robot")
        self.publisher = self.create_publisher(Odometry, "/odom", 10)
        self.talker = self.create_publisher(Odometry, "/own", 10)
        self.create_service(Trigger, "/ask", lambda request, response: response)
        self.client = self.create_client(Trigger, "/ask")
        self.create_timer(0.1, self.tell)

    def tell(self):
        self.client.call_async(Trigger.Request())
        for publisher in (self.publisher, self.talker):
            publisher.publish(Odometry())


class Asker(Node):
    def __init__(self):
        super().__init__("asker")
        self.client = self.create_client(Trigger, "/ask")
        self.create_timer(0.5, lambda: self.client.call_async(Trigger.Request()))


@pytest.fixture(scope="module")
def staged():
    return run(Stager, companions=[Asker], world="yard", seconds=1, quiet=True)


def test_messages_on_a_topic_of_the_course_are_no_evidence(staged):
    kept = evidence_of(staged)
    assert {received.from_course for received in staged.messages("/odom")} == {False, True}
    assert {received.from_course for received in kept.messages("/odom")} == {True}
    assert [end.from_course for end in kept.graph.publishers("/odom")] == [True]
    assert kept.messages("/own") == staged.messages("/own") != []


def test_calls_and_goals_between_a_students_own_nodes_are_no_evidence(staged):
    assert {call.client for call in evidence_of(staged).calls_of("/ask")} == {"/asker"}
    among_themselves = run(actions.Server, actions.Client, seconds=3, quiet=True)
    assert among_themselves.goals
    assert evidence_of(among_themselves).goals == []


@pytest.mark.parametrize(
    ("server", "by_course", "of_course", "kept"),
    [
        ("/server", False, False, False),
        ("/server", True, False, True),
        ("/server", False, True, True),
        ("/server", True, True, True),
        ("", False, False, True),  # no server took it: there is nothing that it could show
    ],
)
def test_a_call_is_evidence_where_the_course_has_an_end_of_it_or_it_has_no_server(
    server, by_course, of_course, kept
):
    call = Call("/ask", "std_srvs/srv/Trigger", "/client", b"", 0.0, server)
    call.requested_by_course, call.served_by_course = by_course, of_course
    assert (evidence_of(recording(calls=[call])).calls == [call]) == kept


def test_where_two_own_a_topic_or_serve_a_service_is_known(staged):
    assert intrusions(staged) == [Intrusion("/odom", "/robot", "/robot", "publisher on")]
    twice = run(Stager, companions=[Stager], seconds=1, quiet=True)
    assert [found[::3] for found in intrusions(twice)] == [
        ("/odom", "publisher on"), ("/own", "publisher on"), ("/ask", "server of"),
    ]  # fmt: skip
    assert intrusions(run(Asker, world="yard", seconds=1, quiet=True)) == []


def test_the_first_look_tells_of_two_owners(staged):
    assert two_owners(staged) == (
        "Two publishers on /odom: /robot, and your /robot. Other nodes can't tell the two apart: use a name of your own, or only subscribe."
    )


def test_a_publisher_that_is_silent_misleads_no_one():
    def silent():
        node = Node("silent")
        node.create_publisher(Odometry, "/odom", 10)
        return node

    assert intrusions(run(silent, world="yard", seconds=1, quiet=True)) == []


def test_who_publishes_on_a_topic_of_the_course_is_reported_and_judged_no_further():
    tells = Exercise("tells", "A node that tells", world="yard", seconds=1)

    @tells.check(2)
    def is_there(run):
        """It publishes."""
        publishes(run, "/own")

    @tells.check(3, after=is_there)
    def is_right(run):
        """It is right."""

    score = tells.grade(Stager)
    assert float(score) == 2.0
    line, _, right = score.verdicts
    assert (line.sentence, line.expected, line.saw, line.hint) == (
        "The node leaves topics and services of other programs alone.",
        "one publisher on /odom: /robot",
        "two, /robot and /robot of yours",
        "Other nodes can't tell the two apart: use a name of your own, or only subscribe.",
    )
    assert right.hint == "Not graded: it isn't clear which program sent what; see above."


def test_an_end_of_the_course_is_none_of_the_students():
    asked = run(Asker, companions=[Asker], seconds=1, quiet=True)
    assert calls(asked, "/ask")
    own = [end._replace(from_course=True) for end in asked.graph.endpoints]
    with pytest.raises(Missed, match="no client for it"):
        calls(dataclasses.replace(asked, graph=dataclasses.replace(asked.graph, endpoints=own)), "/ask")


def test_a_line_that_could_have_all_answers_in_it_is_no_evidence():
    lines = [
        LogLine(1.0, "INFO", "talker", "x" * LONGEST_LINE),
        LogLine(2.0, "INFO", "talker", "x" * (LONGEST_LINE + 1)),
        LogLine(3.0, "INFO", "course", "x" * (LONGEST_LINE + 1), from_course=True),
    ]
    assert evidence_of(recording(logs=lines)).logs == [lines[0], lines[2]]


def test_a_node_that_wrote_only_such_lines_wrote_something():
    lines = [
        LogLine(2.0, "INFO", "talker", "x" * (LONGEST_LINE + 1)),
        LogLine(3.0, "INFO", "course", "x" * (LONGEST_LINE + 1), from_course=True),
    ]
    text = "(a line too long to be an answer)"
    assert evidence_of(recording(logs=lines)).logs == [lines[0]._replace(text=text), lines[1]]
