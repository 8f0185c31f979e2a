"""Time that a student's programs were not at work earns nothing, for whatever reason."""

import pytest

from grader.checks.work import WorkTime, work_of, worked_until
from sim import Recording
from sim.evidence import CallbackError, Ended

ERROR = CallbackError(2.5, "/talker", "Talker.tick", "KeyError", "", "")
LIVES = "A node lives as long as something keeps it spinning: rclpy.spin(node) returns only at shutdown."
STUCK = "tick of node /talker has waited since t = 2.5 s and never returned"


def of(reason, stamp=10.0, detail="", **more):
    return Recording(seconds=10.0, ended=Ended(reason, stamp, detail), **more)


@pytest.mark.parametrize(
    ("recording", "then"),
    [
        (of("time", all_exited_at=2.5), f"your program had ended. {LIVES}"),
        (of("finished", 3.5, all_exited_at=2.5), f"your program had ended. {LIVES}"),
        (of("error", all_exited_at=2.5, errors=[ERROR]), "the error above ended it."),
        (of("hang", 2.5), "the error above ended it."),
        (of("livelock", 2.5), "the error above ended it."),
        (of("blocked", detail=STUCK), "nothing kept running."),
    ],
)
def test_ended_crashed_hung_or_stuck_it_is_the_same_part(recording, then):
    assert worked_until(recording) == 2.5
    assert work_of(recording) == WorkTime(0.25, f"Earned for 2.5 of 10 s: then {then}")


@pytest.mark.parametrize(
    "recording",
    [
        of("time"),
        of("goal", 4.0),
        of("interrupted", 4.0),
        of("error", errors=[ERROR]),
        of("time", all_exited_at=10.0),
        of("time", all_exited_at=10.0 - 5e-7),  # but for rounding
        of("error", 2.5, errors=[ERROR]),  # the run ended with it, the program did not
        Recording(ended=Ended("hang", 0.0, "")),  # nothing was to be run
    ],
)
def test_who_was_at_work_to_the_end_has_all_of_it(recording):
    assert work_of(recording) == WorkTime(1.0)


def test_where_a_program_may_end_what_it_has_done_until_then_counts():
    assert work_of(of("finished", 3.5, all_exited_at=2.5), may_end=True) == WorkTime(1.0)
    assert work_of(of("error", all_exited_at=2.5, errors=[ERROR]), may_end=True) == WorkTime(1.0)
    assert work_of(of("hang", 2.5), may_end=True).share == 0.25


def test_a_program_that_ends_a_millisecond_early_loses_that_millisecond():
    assert work_of(of("time", all_exited_at=9.9995)).share == pytest.approx(0.99995)


def test_of_a_run_that_came_to_its_goal_the_time_until_then_counts():
    work = work_of(of("goal", 4.0, all_exited_at=2.0))
    assert work == WorkTime(0.5, f"Earned for 2 of 4 s: then your program had ended. {LIVES}")
