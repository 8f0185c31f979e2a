"""Stimuli of the course with the student's responses, and the misses that they raise."""

import pytest
from std_msgs.msg import Float64

from grader.checks import Missed
from grader.responses import Stimuli, from_course, last_before
from sim.evidence import Ended, Endpoint, Graph, Message, Recording
from sim.ros.messages.codec import encode

ASKED = Stimuli("/wanted", answered_on="/command", within=0.5)


def row(stamp, topic, value, from_course=False):
    sender = "/caller" if from_course else "/node"
    return Message(stamp, topic, "std_msgs/msg/Float64", sender, encode(Float64(data=value)), from_course)


def recorded(*rows, seconds=5.0):
    ends = [Endpoint("publisher", "/caller", "/wanted", "std_msgs/msg/Float64", {}, from_course=True)]
    ended = Ended("time", seconds, "")
    return Recording(seconds=seconds, published=list(rows), graph=Graph(["/caller"], ends), ended=ended)


def test_a_response_is_what_the_student_publishes_in_the_window():
    run = recorded(
        row(1.0, "/wanted", 7.0, True),
        row(1.2, "/command", 7.0),
        row(1.2, "/command", 8.0, True),
        row(1.5, "/command", 9.0),
        row(1.6, "/command", 10.0),
    )
    [stimulus] = ASKED(run)
    assert (stimulus.stamp, stimulus.value.data, stimulus.values()) == (1.0, 7.0, [7.0, 9.0])
    stimulus.expects(9.0)


def test_a_wrong_response_is_missed_with_what_was_wanted_and_seen():
    [stimulus] = ASKED(recorded(row(1.0, "/wanted", 7.0, True), row(1.2, "/command", 6.5)))
    with pytest.raises(Missed) as missed:
        stimulus.expects(7.0, hint="Pass it on.")
    found = missed.value
    assert (found.expected, found.saw, found.hint) == (
        "7 on /command within 0.5 s of 1 s",
        "6.5",
        "Pass it on.",
    )
    assert found.about == (stimulus,)


def test_no_response_is_nothing_and_may_be_what_is_right():
    [stimulus] = ASKED(recorded(row(1.0, "/wanted", 7.0, True)))
    stimulus.expects_nothing("no command")
    assert stimulus.seen() == "nothing"
    [stimulus] = ASKED(recorded(row(1.0, "/wanted", 7.0, True), row(1.1, "/command", 7.0)))
    with pytest.raises(Missed, match=r"^expected no command; saw 7$"):
        stimulus.expects_nothing("no command", "Refuse it.")


def test_what_had_no_time_for_a_response_is_left_out():
    rows = row(1.0, "/wanted", 1.0, True), row(4.5, "/wanted", 2.0, True), row(4.8, "/wanted", 3.0, True)
    assert [one.stamp for one in ASKED(recorded(*rows))] == [1.0]
    assert [one.stamp for one in ASKED(recorded(*rows), where=lambda msg: msg.data > 0.5)] == [1.0]


def test_a_response_before_it_is_possible_does_not_count():
    slow = Stimuli("/wanted", answered_on="/command", within=0.5, not_before=0.3)
    [stimulus] = slow(
        recorded(row(1.0, "/wanted", 7.0, True), row(1.2, "/command", 7.0), row(1.4, "/command", 8.0))
    )
    assert (stimulus.values(), stimulus.within) == ([8.0], 0.5)


def test_no_stimulus_of_the_course_is_our_mistake():
    with pytest.raises(
        ValueError, match=r"^nodes of the exercise's own should have sent messages on /wanted: 0$"
    ):
        ASKED(recorded())
    with pytest.raises(ValueError, match=r"should have sent requests: none$"):
        from_course(recorded(row(1.0, "/wanted", 1.0)), "/wanted", what="requests")


def test_the_last_row_before_a_stamp():
    rows = [row(1.0, "/a", 1.0), row(2.0, "/a", 2.0)]
    assert last_before(rows, 1.5) is rows[0]
    assert last_before(rows, 2.0) is rows[1]
    assert last_before(rows, 0.5) is None
