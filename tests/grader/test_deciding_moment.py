"""Replays of misses that name no time open before the moment that shows them."""

import pytest
from std_msgs.msg import String

from grader.checks.verdicts import Verdict
from grader.deciding_moment import deciding_moment
from grader.pictures import score_pictures
from sim.evidence import LogLine
from sim.view.packing import inflated
from tests.sim.recordings import driven, published

STOPS = [(0, 0), (0, 0), (0, 0), (1, 0), (2, 0), (2, 0), (2, 0)]  # one a second


def missed(expected="", saw="", picture="path"):
    return Verdict("works", "It works.", 1.0, "failed", 0.0, expected, saw, picture=picture)


@pytest.mark.parametrize(
    "expected, saw, stamp",
    [
        ("a robot that stands still before the first call", "it moved 0.17 m", 3.0),
        ("(4, 0) m", "(2.00, 0.00) m, which is 2.00 m away", 3.0),
        ("a drive of 3 m", "it stood", 3.0),
        ("an answer", "none", None),
    ],
)
def test_a_motion_is_shown_where_it_begins_or_the_robot_comes_to_its_last_place(expected, saw, stamp):
    assert deciding_moment(missed(expected, saw), driven(STOPS)) == stamp


def test_a_robot_that_never_moves_shows_nothing():
    assert deciding_moment(missed("a drive of 3 m", "it stood"), driven([(0, 0), (0, 0)])) is None


@pytest.mark.parametrize("saw, stamp", [("String on /talk", 2.0), ("none for 5 s", 4.0), ("it stopped", 4.0)])
def test_a_topic_is_shown_at_its_first_message_or_the_last_one_before_silence(saw, stamp):
    run = published("/talk", [(2.0, String(data="a")), (4.0, String(data="b"))])
    assert deciding_moment(missed("a message on /talk", saw), run) == stamp


def test_a_log_line_is_shown_when_it_was_written():
    run = driven(STOPS, logs=[LogLine(1.5, "INFO", "talker", "hello"), LogLine(2.5, "INFO", "talker", "bye")])
    assert deciding_moment(missed("“ciao”", "“bye”"), run) == 2.5


def opened(*verdicts):
    ((_, replay),) = score_pictures(verdicts, [driven(STOPS)])
    return inflated(replay.html.split('data-replay="')[1].split('"')[0]).get("open")


def test_the_replay_opens_a_second_before_it_unless_a_miss_names_a_time():
    moved = missed("a robot that stands still", "it moved 2.00 m")
    assert opened(moved) == 2.0
    assert opened(moved, missed("a stop", "it moved at 5 s")) == 4.0
    assert opened(missed("an answer", "none")) is None
