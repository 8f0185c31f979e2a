import dataclasses

import pytest

from grader import Missed, check
from grader.checks import judge
from grader.checks.judge import worst
from sim import Recording, run
from sim.evidence import CallbackError, Ended
from tests.students import misfits
from tests.students.engine import errors


@check(points=1)
def sends(recording):
    """It sends messages."""
    if not recording.seed:
        raise Missed("messages", "none", "Send some.")


@check(points=2, after=sends)
def paced(recording):
    """It sends them in time."""


@check(points=1, after=paced)
def ends(recording):
    """It ends in time."""


@check(points=3)
def half(recording):
    """It does both parts."""
    raise Missed("both", "one", "The other, too.", credit=0.5)


@check(points=1, after=half)
def more(recording):
    """It does more."""
    raise Missed("all", "a quarter", "The rest, too.", credit=0.25)


@check(points=5)
def faulty_check(recording):
    """It has a mistake of ours."""
    return recording.no_such_thing


def statuses(verdicts):
    return {verdict.name: verdict.status for verdict in verdicts}


def failing_at(stamp, type="KeyError"):
    error = CallbackError(stamp, "/talker", "Talker.tick", type, "count", "")
    return Recording(errors=[error], all_exited_at=stamp)


def test_all_is_well():
    verdicts = judge([sends, paced, ends], Recording(seed=1))
    assert statuses(verdicts) == {"sends": "passed", "paced": "passed", "ends": "passed"}
    assert [verdict.earned for verdict in verdicts] == [1.0, 2.0, 1.0]


def test_a_miss_says_expected_saw_and_hint():
    (verdict,) = judge([sends], Recording())
    assert (verdict.status, verdict.credit) == ("failed", 0.0)
    assert (verdict.expected, verdict.saw, verdict.hint) == ("messages", "none", "Send some.")


def test_what_an_earlier_miss_explains_is_skipped_down_the_line():
    verdicts = judge([sends, paced, ends], Recording())
    assert statuses(verdicts) == {"sends": "failed", "paced": "skipped", "ends": "skipped"}
    assert [verdict.hint for verdict in verdicts[1:]] == [
        "Not judged: first comes “It sends messages.”",
        "Not judged: first comes “It sends them in time.”",
    ]


def test_partial_credit_explains_nothing():
    verdicts = judge([half, more], Recording())
    assert statuses(verdicts) == {"half": "failed", "more": "failed"}
    assert [verdict.earned for verdict in verdicts] == [1.5, 0.0]


def test_a_check_that_raises_leaves_its_points_to_the_instructor():
    (verdict,) = judge([faulty_check], Recording())
    assert (verdict.status, verdict.earned) == ("broken", 0.0)
    assert verdict.hint == (
        "Nothing to do: this check has a mistake of its own. Your instructor decides about its points."
    )
    assert verdict.alarm.endswith("AttributeError: 'Recording' object has no attribute 'no_such_thing'\n")
    assert "in faulty_check" in verdict.alarm


def test_an_error_comes_first_and_explains_what_then_misses():
    verdicts = judge([sends, half], failing_at(2.0))
    assert statuses(verdicts) == {"runs": "failed", "sends": "skipped", "half": "failed"}
    assert (verdicts[0].sentence, verdicts[0].points) == ("Your code runs without an error.", 0.0)
    assert verdicts[0].saw == "KeyError: count (in Talker.tick, at 2 s)"
    assert verdicts[1].hint == "Not judged: the error above explains it."


def test_what_passed_before_an_error_counts():
    recording = dataclasses.replace(failing_at(2.0), seed=1)
    assert statuses(judge([sends], recording)) == {"runs": "failed", "sends": "passed"}


@check(points=1, after=sends)
def ticks(recording):
    """It ticks once a second."""
    if [line.stamp for line in recording.logs] != [1.0, 2.0, 3.0]:
        raise Missed("three ticks", "others")


def test_a_thread_that_crashes_is_told_and_costs_nothing_that_goes_on():
    error, ticking = judge([ticks], run(errors.in_thread, seconds=3, quiet=True))
    assert (error.saw, error.status) == ("KeyError: 'in thread' (in thread work, line 113, at 0 s)", "failed")
    assert (ticking.status, ticking.earned) == ("passed", 1.0)


@pytest.mark.parametrize("reason", ["hang", "livelock", "blocked"])
def test_who_gets_stuck_has_the_share_of_the_points_in_which_nothing_was_wrong(reason):
    recording = Recording(seconds=10.0, seed=1, ended=Ended(reason, 2.5, "It waits."))
    error, first, second, _ = judge([sends, paced, ends], recording)
    assert (error.name, error.saw) == ("runs", "It waits.")
    assert (first.status, first.earned) == ("passed", 1.0)
    assert (second.status, second.earned) == ("skipped", 0.5)
    then = "nothing went on" if reason == "blocked" else "the error above ended it"
    assert second.hint == f"Earned for 2.5 of 10 s: then {then}."


@check(points=4, after=sends)
def stays_off(recording):
    """It hurts nobody."""
    raise Missed("no contact", "one", unsafe=True)


def test_what_is_unsafe_is_told_even_where_an_error_would_explain_it():
    recording = dataclasses.replace(failing_at(2.0), seed=1)
    *_, verdict = judge([sends, stays_off], recording)
    assert (verdict.status, verdict.unsafe, verdict.saw) == ("failed", True, "one")


def test_of_several_runs_the_one_that_was_unsafe_is_told():
    def safe(recording):
        """It hurts nobody."""
        raise Missed("a way", "none")

    poor = judge([sends, dataclasses.replace(stays_off, function=safe)], Recording(seed=1))
    unsafe = judge([sends, stays_off], Recording(seed=1))
    assert worst([sends, stays_off], [poor, unsafe])[1].unsafe


@pytest.mark.parametrize("reason", ["goal", "finished", "time"])
def test_a_run_that_ends_early_as_it_should_is_judged_whole(reason):
    recording = Recording(seconds=10.0, seed=1, ended=Ended(reason, 2.5, "It is over."))
    assert [verdict.credit for verdict in judge([sends, paced, ends], recording)] == [1.0] * 3


@pytest.mark.parametrize("recording", [failing_at(0.0), failing_at(2.0, "NotImplementedError")])
def test_nothing_passes_by_itself_when_no_node_came_up(recording):
    recording = dataclasses.replace(recording, seed=1)
    assert statuses(judge([sends, half], recording)) == {
        "runs": "failed",
        "sends": "skipped",
        "half": "skipped",
    }


@check(points=1)
def first_without_hint(recording):
    """It publishes."""
    raise Missed("messages", "none")


@check(points=1)
def second_without_hint(recording):
    """It logs."""
    raise Missed("lines", "none")


def test_a_miss_without_a_hint_gets_the_diagnosis_and_a_second_one_is_explained_by_it():
    verdicts = judge([first_without_hint, second_without_hint], run(misfits.Empty, seconds=1, quiet=True))
    assert statuses(verdicts) == {"first_without_hint": "failed", "second_without_hint": "skipped"}
    assert (
        verdicts[0].hint
        == "/talker has no publisher, no subscription and no timer: nothing can happen in it."
    )
    assert verdicts[1].hint == "Not judged: the hint above explains it."


def test_misses_that_nothing_explains_are_all_told():
    verdicts = judge([first_without_hint, second_without_hint], run(misfits.Talker, seconds=1, quiet=True))
    assert statuses(verdicts) == {"first_without_hint": "failed", "second_without_hint": "failed"}


def test_of_several_runs_each_check_gets_its_worst():
    good, bad = judge([sends, half], Recording(seed=1)), judge([sends, half], failing_at(1.0))
    verdicts = worst([sends, half], [good, bad])
    assert [(v.name, v.status, v.run) for v in verdicts] == [
        ("runs", "failed", 1),
        ("sends", "skipped", 1),
        ("half", "failed", 0),
    ]


def test_a_broken_run_does_not_hide_a_miss_nor_the_alarm():
    broken, missed, passed = (judge([faulty_check], Recording()) for _ in range(3))
    missed = [dataclasses.replace(missed[0], status="failed", credit=0.0)]
    passed = [dataclasses.replace(passed[0], status="passed", credit=1.0, alarm="")]
    assert worst([faulty_check], [broken, missed])[0].status == "failed"
    assert worst([faulty_check], [passed, broken])[0].status == "broken"
