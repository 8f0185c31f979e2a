import dataclasses

import pytest

from grader import Missed, check
from grader.checks import judge
from grader.checks.check import new_check
from grader.checks.verdicts import Verdict, halves, worst
from sim import Recording, run
from sim.evidence import CallbackError, Ended, Endpoint, Graph, Message
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
    """It has a mistake of the course."""
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
        "Not graded yet: fix this first: “It sends messages.”",
        "Not graded yet: fix this first: “It sends them in time.”",
    ]


def test_partial_credit_explains_nothing():
    verdicts = judge([half, more], Recording())
    assert statuses(verdicts) == {"half": "failed", "more": "failed"}
    assert [verdict.earned for verdict in verdicts] == [1.5, 0.0]


def test_a_check_that_raises_leaves_its_points_to_the_instructor():
    (verdict,) = judge([faulty_check], Recording())
    assert (verdict.status, verdict.earned) == ("broken", 0.0)
    assert verdict.hint == (
        "Nothing for you to do: this check itself has a bug. Your instructor decides on its points."
    )
    assert verdict.alarm.endswith("AttributeError: 'Recording' object has no attribute 'no_such_thing'\n")
    assert "in faulty_check" in verdict.alarm


def test_an_error_comes_first_and_explains_what_then_misses():
    verdicts = judge([sends, half], failing_at(2.0))
    assert statuses(verdicts) == {"runs": "failed", "sends": "skipped", "half": "failed"}
    assert (verdicts[0].sentence, verdicts[0].points) == ("Your code runs without an error.", 0.0)
    assert verdicts[0].saw == "KeyError: count (in Talker.tick, at 2 s)"
    assert verdicts[1].hint == "Not graded: the error above explains it."


def test_what_passed_before_an_error_counts():
    recording = dataclasses.replace(failing_at(2.0), seed=1)
    assert statuses(judge([sends], recording)) == {"runs": "failed", "sends": "passed"}


@check(points=1, after=sends)
def ticks(recording):
    """It ticks once a second."""
    if [line.stamp for line in recording.logs] != [1.0, 2.0, 3.0]:
        raise Missed("three ticks", "others")


def test_a_thread_that_crashes_is_reported_and_costs_nothing_that_goes_on():
    error, ticking = judge([ticks], run(errors.in_thread, seconds=3, quiet=True))
    assert (error.saw, error.status) == ("KeyError: 'in thread' (in thread work, line 114, at 0 s)", "failed")
    assert (ticking.status, ticking.earned) == ("passed", 1.0)


@pytest.mark.parametrize("reason", ["hang", "livelock", "blocked"])
def test_who_gets_stuck_has_the_share_of_the_points_in_which_nothing_was_wrong(reason):
    recording = Recording(seconds=10.0, seed=1, ended=Ended(reason, 2.5, "It waits."))
    error, first, second, _ = judge([sends, paced, ends], recording)
    assert (error.name, error.saw) == ("runs", "It waits.")
    assert (first.status, first.earned) == ("passed", 1.0)
    assert (second.status, second.earned) == ("skipped", 0.5)
    then = "nothing kept running" if reason == "blocked" else "the error above ended it"
    assert second.hint == f"Earned for 2.5 of 10 s: then {then}."


@check(points=4, after=sends)
def stays_off(recording):
    """It hurts no one."""
    raise Missed("no contact", "one", unsafe=True)


def test_what_is_unsafe_is_reported_even_where_an_error_would_explain_it():
    recording = dataclasses.replace(failing_at(2.0), seed=1)
    *_, verdict = judge([sends, stays_off], recording)
    assert (verdict.status, verdict.unsafe, verdict.saw) == ("failed", True, "one")


def test_of_several_runs_the_one_that_was_unsafe_is_reported():
    def safe(recording):
        """It hurts no one."""
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
    assert verdicts[1].hint == "Not graded: the hint above explains it."


def test_misses_that_nothing_explains_are_all_reported():
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


@pytest.mark.parametrize(
    ("points", "credit", "earned"),
    [
        (3.0, 1.0, 3.0),
        (0.7, 1.0, 0.7),  # all of the points, though they are no halves
        (0.7, 0.999, 0.5),
        (10.0, 0.9, 9.0),
        (10.0, 0.94, 9.0),
        (5.0, 1 - 0.9, 0.5),  # 0.4999999999999999: what is lost by rounding is not the student's
        (5.0, 0.0999, 0.0),
        (5.0, 0.0, 0.0),
    ],
)
def test_a_part_of_the_points_is_rounded_down_to_halves(points, credit, earned):
    assert Verdict("it", "It works.", points, "failed", credit).earned == earned


def test_halves_are_never_more_than_was_earned():
    assert [halves(points) for points in (0.0, 0.49, 0.4997, 0.5, 0.99, 7.0)] == [0.0, 0.0, 0.0, 0.5, 0.5, 7.0]


def missing(points=4, after=(), **missed):
    """A check that always misses."""

    def parts(recording):
        """It does its part."""
        raise Missed("all", "some", **missed)

    return new_check(parts, points, after)


def spoofing(*topics):
    """A run in which /faker publishes where only the course's /robot should."""
    messages = [Message(1.0, topic, "std_msgs/msg/Empty", "/faker", b"") for topic in topics]
    ends = [
        Endpoint("publisher", node, topic, "std_msgs/msg/Empty", {}, from_course=node == "/robot")
        for topic in topics
        for node in ("/robot", "/faker")
    ]
    return Recording(seed=1, published=messages, graph=Graph(["/robot", "/faker"], ends))


def test_of_topics_with_two_owners_the_first_is_named_and_carries_no_points():
    line, first, second = judge([sends, paced], spoofing("/odom", "/scan"))
    assert line == Verdict(
        "keeps_apart",
        "The node leaves topics and services of other programs alone.",
        0.0,
        "failed",
        0.0,
        "one publisher on /odom: /robot",
        "two, /robot and /faker of yours",
        "Other nodes can't tell the two apart: use a name of your own, or only subscribe.",
    )
    assert (first.status, first.earned) == ("passed", 1.0)
    hint = "Not graded: it isn't clear which program sent what; see above."
    assert (second.status, second.earned, second.hint) == ("skipped", 0.0, hint)


def test_the_line_of_an_error_carries_no_points_and_no_credit():
    (line, *_) = judge([sends], failing_at(2.0))
    assert (line.points, line.credit, line.earned, line.run, line.unsafe) == (0.0, 0.0, 0.0, 0, False)


def exited_at(stamp, seconds=10.0):
    """A run whose programs had all exited at this time, without an error."""
    ended = Ended("finished", stamp, "They exited.")
    return Recording(seconds=seconds, seed=1, ended=ended, all_exited_at=stamp)


def test_time_after_a_programs_exit_is_not_earned_unless_the_exercise_says_that_it_may_exit():
    early = exited_at(2.5)
    assert [verdict.credit for verdict in judge([sends, paced], early)] == [1.0, 0.25]
    assert [verdict.credit for verdict in judge([sends, paced], early, may_end=True)] == [1.0, 1.0]


def test_a_program_that_exits_shortly_before_the_end_loses_that_time_too():
    (_, second) = judge([sends, paced], exited_at(9.0))
    assert (second.status, second.credit) == ("skipped", 0.9)


def test_partial_credit_is_for_the_part_of_the_time_in_which_the_program_ran():
    alone, builds_on = missing(points=8, credit=0.5), missing(points=8, after=sends, credit=0.5)
    verdicts = judge([alone], exited_at(2.5)) + judge([sends, builds_on], exited_at(2.5))
    assert [verdict.credit for verdict in verdicts] == [0.5, 1.0, 0.125]


def measuring(*results):
    """A check that measures something, with a miss that earns half; and one that is handed what it measured."""

    def measures(recording):
        """It measures."""
        raise Missed("all", "some", credit=0.5, **dict(zip(["measured"], results, strict=False)))

    def uses(recording, measured):
        """It uses the result."""
        if measured != 7:
            raise Missed("7", f"{measured}")

    first = new_check(measures, 2)
    return [first, new_check(uses, 2, first)]


def test_a_check_is_handed_what_a_miss_with_partial_credit_has_measured():
    assert statuses(judge(measuring(7), Recording())) == {"measures": "failed", "uses": "passed"}
    _, second = judge(measuring(8), Recording())
    assert (second.status, second.saw) == ("failed", "8")


def test_a_check_that_is_handed_nothing_by_a_miss_is_broken_and_says_whose_fault_it_is():
    _, second = judge(measuring(), Recording())
    assert second.status == "broken"
    problem = "ValueError: measures missed without saying what it measured: uses can't be judged"
    assert second.alarm.endswith(f"{problem}\n")


def test_of_several_checks_that_measured_nothing_the_first_is_named():
    def both(recording, one, other):
        """It uses both."""

    (first, _), others = measuring(), measuring()
    other = dataclasses.replace(others[0], name="measures_too")
    *_, verdict = judge([first, other, new_check(both, 1, (first, other))], Recording())
    assert "ValueError: measures missed without saying what it measured: both can't" in verdict.alarm


def test_a_check_that_takes_no_results_is_judged_whatever_was_measured():
    (first, _) = measuring()
    assert statuses(judge([first, missing(after=first, credit=0.5)], Recording())) == {
        "measures": "failed",
        "parts": "failed",
    }


def test_a_typo_is_kept_with_a_miss_and_where_an_error_explains_it():
    typo = ("/sacn", "/scan")
    assert judge([missing(typo=typo)], Recording())[0].typo == typo
    _, explained = judge([missing(typo=typo)], failing_at(2.0))
    assert (explained.status, explained.typo) == ("skipped", typo)


def unlistened():
    """A run with a diagnosis: a node without anything that could happen in it."""
    return Recording(seed=1, graph=Graph(["/talker"]), ended=Ended("time", 1.0, ""), seconds=1.0)


EMPTY = "/talker has no publisher, no subscription and no timer: nothing can happen in it."


def test_a_second_miss_of_the_same_cause_is_judged_where_it_earns_something_or_is_unsafe():
    first = missing()
    partial = dataclasses.replace(missing(credit=0.5), name="partial")
    unsafe = dataclasses.replace(missing(unsafe=True), name="unsafe")
    verdicts = judge([first, partial, unsafe], unlistened())
    assert [(verdict.status, verdict.credit, verdict.hint) for verdict in verdicts] == [
        ("failed", 0.0, EMPTY),
        ("failed", 0.5, EMPTY),
        ("failed", 0.0, EMPTY),
    ]


@pytest.mark.parametrize(
    ("own", "recording", "hint"),
    [
        ({"hint": "Its hint.", "guess": "Its guess."}, unlistened(), "Its hint."),
        ({"guess": "Its guess."}, unlistened(), EMPTY),
        ({"guess": "Its guess."}, Recording(), "Its guess."),
        ({}, Recording(), "The check's guess."),
    ],
)
def test_a_hint_comes_before_the_diagnosis_and_guesses_come_after_it(own, recording, hint):
    assert judge([missing(**own) if "hint" in own else guessing(**own)], recording)[0].hint == hint


def guessing(**own):
    return dataclasses.replace(missing(**own), guess="The check's guess.")


def verdict(status, credit=0.0, **more):
    return Verdict("it", "It works.", 4.0, status, credit, **more)


def chosen(*verdicts):
    return worst([dataclasses.replace(sends, name="it")], [[one] for one in verdicts])[0]


def test_an_unsafe_run_is_shown_with_the_least_credit_of_all_runs():
    safe, unsafe = verdict("failed", 0.25, saw="too little"), verdict("failed", 0.5, saw="a bump", unsafe=True)
    assert chosen(safe, unsafe) == verdict("failed", 0.25, saw="a bump", unsafe=True, run=1)


def test_where_runs_earn_the_same_a_miss_is_shown_before_what_was_skipped_and_that_before_what_is_broken():
    assert chosen(verdict("skipped"), verdict("broken"), verdict("failed")).status == "failed"
    assert chosen(verdict("broken"), verdict("skipped")).status == "skipped"
    assert chosen(verdict("passed"), verdict("broken")).status == "broken"
    assert chosen(verdict("passed", 1.0), verdict("failed", 1.0)).status == "failed"


def test_a_run_that_earns_less_is_shown_whatever_became_of_it():
    assert chosen(verdict("failed", 0.5), verdict("broken", 0.0)).status == "broken"


@check(points=1)
def follows(recording):
    """It follows."""
    raise Missed("feedback", "none", "Fix the rest first.", because=(sends, half))


def test_what_an_earlier_miss_has_caused_is_skipped():
    verdicts = {verdict.name: verdict for verdict in judge([sends, half, follows], Recording(seed=1))}
    assert verdicts["follows"].status == "skipped"
    assert verdicts["follows"].hint == "Not graded yet: fix this first: “It does both parts.”"


def test_without_that_miss_it_is_one_of_its_own():
    def passes(recording):
        """It does both parts."""

    passes = check(points=1)(passes)

    @check(points=1)
    def alone(recording):
        """It follows."""
        raise Missed("feedback", "none", "Fix the rest first.", because=(passes,))

    assert statuses(judge([passes, alone], Recording(seed=1))) == {"passes": "passed", "alone": "failed"}
