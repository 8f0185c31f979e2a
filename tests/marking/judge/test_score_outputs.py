"""What of a score goes to the instructor alone."""

from grader import Score
from grader.checks.verdicts import SPOOFED_TOPICS, Verdict
from grader.marking.judge.score_outputs import spoofed_topics, unused_offers
from sim.evidence import Endpoint, Graph
from tests.sim.recordings import recording


def test_a_topic_with_two_owners_is_flagged():
    line = Verdict(
        SPOOFED_TOPICS,
        "",
        0.0,
        "failed",
        0.0,
        "one publisher on /odom: /robot",
        "two, /robot and /square of yours",
    )
    assert spoofed_topics(Score("square", [line, Verdict("drives", "", 2.0, "passed", 1.0)])) == [
        "one publisher on /odom: /robot; there were two, /robot and /square of the student"
    ]


def ends(*rows):
    """The score of a run with these endpoints: kind, name, and whether it is the course's."""
    type = "std_msgs/msg/String"
    graph = Graph(["/n"], [Endpoint(kind, "/n", name, type, {}, course) for kind, name, course in rows])
    return Score("numbers", [Verdict("adds", "", 2.0, "passed", 1.0)], [recording(graph=graph)])


def test_full_points_without_what_the_course_offers_are_flagged():
    offers = ("publisher", "/numbers", True), ("service", "/shelf_of", True), ("publisher", "/scan", True)
    assert unused_offers(ends(*offers, ("publisher", "/sum", False))) == [
        "full points, although its nodes use nothing of what the course's programs offer: /numbers, /shelf_of"
    ]
    assert unused_offers(ends(*offers, ("subscription", "/numbers", False))) == []
    assert unused_offers(ends(*offers, ("client", "/shelf_of", False))) == []
    assert unused_offers(ends(offers[2])) == []  # a right program may drive without the robot's sensors


def test_points_that_are_not_full_need_no_flag():
    offered = ends(("publisher", "/numbers", True))
    missed = Verdict("adds", "", 2.0, "failed", 0.0)
    assert unused_offers(Score("numbers", [missed], offered.recordings)) == []
