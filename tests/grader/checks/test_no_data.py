"""A measure that finds no data: the student's miss, or a mistake of the exercise."""

import pytest

from grader import Missed
from grader.checks.no_data import no_data
from sim import Recording
from sim.evidence import Ended, Endpoint

STUDENT = Endpoint("publisher", "/talker", "/scan", "sensor_msgs/msg/LaserScan", {})
COURSE = STUDENT._replace(node="/robot", from_course=True)


def raised(reason="time", stamp=10.0, senders=(STUDENT,)):
    return no_data(Recording(seconds=10.0, ended=Ended(reason, stamp, "It ended.")), "scans", "none", senders)


@pytest.mark.parametrize("senders", [(), (STUDENT,)])
def test_where_the_student_could_have_sent_it_the_student_missed_it(senders):
    miss = raised(senders=senders)
    assert isinstance(miss, Missed)
    assert (miss.expected, miss.saw, miss.hint) == ("scans", "none", "")


def test_where_the_course_should_have_sent_it_the_exercise_is_wrong():
    for senders in ([COURSE], [STUDENT, COURSE]):
        mistake = raised(senders=senders)
        assert isinstance(mistake, ValueError)
        assert str(mistake) == "nodes of the exercise's own should have sent scans: none"


def test_where_the_run_ended_early_the_student_missed_it_whichever_program_should_have_sent_it():
    miss = raised("hang", 9.9, [COURSE])
    assert isinstance(miss, Missed)
    assert (miss.expected, miss.saw) == ("a run that lasts until there are scans", "It ended.")


@pytest.mark.parametrize(("reason", "stamp"), [("finished", 10.0), ("time", 9.9)])
def test_a_run_to_the_end_of_its_time_did_not_end_early(reason, stamp):
    assert isinstance(raised(reason, stamp, [COURSE]), ValueError)
