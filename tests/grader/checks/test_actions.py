import math

import pytest
from example_interfaces.action import Fibonacci
from nav2_msgs.action import NavigateToPose

from grader import Missed
from grader.checks import accepts, cancels, finishes, gives_feedback, rejects, sends_goals, serves_action
from sim import run
from sim.evidence import Endpoint, Goal, Message
from sim.ros.messages.codec import encode
from tests.sim.recordings import recording
from tests.students import service_misfits as misfits
from tests.students.engine import actions, goals

FIBONACCI = "example_interfaces/action/Fibonacci"
NAVIGATE = "nav2_msgs/action/NavigateToPose"
GOAL = "the goal /fibonacci (order=3) at 0 s"


def ran(*programs, seconds=6):
    return run(*programs, seconds=seconds, quiet=True)


def missed(function, *arguments, **options):
    with pytest.raises(Missed) as caught:
        function(*arguments, **options)
    return caught.value


def fibonacci(request):
    numbers = [0, 1]
    for _ in range(request.order):
        numbers.append(sum(numbers[-2:]))
    return {"sequence": numbers}


def driven(*distances, end=4.0, begin=0.0, period=1.0):
    """A goal for /navigate whose feedback gives these distances, one a second."""
    feedback = [
        Message(stamp, "/navigate/_action/feedback", f"{NAVIGATE}_Feedback", "/navigator", encode(message))
        for n, distance in enumerate(distances, 1)
        for stamp, message in [(begin + n * period, NavigateToPose.Feedback(distance_remaining=distance))]
    ]
    events = [(begin, "accepted"), (begin, "executing"), (end, "succeeded")]
    raw = encode(NavigateToPose.Goal())
    goal = Goal("/navigate", NAVIGATE, "/client", "00" * 16, raw, 0.0, "/navigator", events, feedback)
    return recording(goals=[goal])


def asked(*goals):
    """A run with goals for /fibonacci, given as their order, the events, and the result's numbers if any."""
    rows = []
    for order, events, *sequence in goals:
        request = encode(Fibonacci.Goal(order=order))
        row = Goal("/fibonacci", FIBONACCI, "/client", "00" * 16, request, 0.0, "/server", list(events))
        row.raw_result = encode(Fibonacci.Result(sequence=sequence[0])) if sequence else None
        rows.append(row)
    return recording(goals=rows)


def succeeded(begin, end):
    return (begin, "accepted"), (begin, "executing"), (end, "succeeded")


def test_serves_action_finds_the_server():
    (end,) = serves_action(ran(actions.Server), "/fibonacci", FIBONACCI)
    assert end.node == "/server"


def test_serves_action_misses_one_that_no_one_offers():
    miss = missed(serves_action, recording(), "/fibonacci", FIBONACCI)
    assert (miss.expected, miss.saw) == (
        f"an action server /fibonacci of type {FIBONACCI}",
        "no server for it",
    )
    miss = missed(serves_action, ran(misfits.MisspeltAction), "/fibonacci")
    assert (miss.saw, miss.hint) == (
        "no server for it; there is one for /fibonaci", "Is /fibonaci a typo? Did you mean /fibonacci?",
    )  # fmt: skip
    miss = missed(serves_action, ran(actions.Server), "/fibonacci", NAVIGATE)
    assert miss.hint == f"Both ends of an action must use the same type: on /fibonacci it is {NAVIGATE}."


def test_sends_goals_gives_the_goals():
    assert [goal.request.order for goal in sends_goals(ran(goals.asks_no_one), "/fibonacci", FIBONACCI)] == [
        1
    ]


def test_sends_goals_misses_a_client_and_its_goals():
    miss = missed(sends_goals, ran(actions.Server), "/fibonacci")
    assert (miss.expected, miss.saw) == ("an action client for /fibonacci", "no client for it")
    miss = missed(sends_goals, ran(actions.Server), "/fibonacci", FIBONACCI)
    assert miss.expected == f"an action client for /fibonacci of type {FIBONACCI}"
    miss = missed(sends_goals, ran(actions.Client, seconds=1), "/fibonacci", FIBONACCI)
    assert (miss.expected, miss.saw) == ("a goal for /fibonacci", "a client, but no goal")
    miss = missed(sends_goals, ran(goals.asks_no_one), "/fibonacci", at_least=2)
    assert (miss.expected, miss.saw) == ("2 or more goals for /fibonacci", "only 1 in 6 s")


def test_goals_are_accepted_and_rejected_by_what_they_ask():
    assert len(accepts(ran(actions.Server, actions.Client), "/fibonacci")) == 1
    assert len(rejects(ran(actions.Server, actions.Greedy), "/fibonacci")) == 1


def test_accepts_misses_a_goal_that_is_rejected():
    miss = missed(accepts, ran(actions.Server, actions.Greedy), "/fibonacci")
    assert (miss.expected, miss.saw) == ("the goal /fibonacci (order=10) at 0 s accepted", "rejected at 0 s")


def test_rejects_misses_a_goal_that_is_accepted():
    miss = missed(rejects, ran(actions.Server, actions.Client), "/fibonacci")
    assert (miss.expected, miss.saw, miss.credit) == (f"{GOAL} rejected", "succeeded at 3 s", 0.0)


def test_the_first_goal_of_another_decision_is_named_and_the_others_give_credit():
    run = asked((1, succeeded(0.0, 1.0)), (2, [(1.0, "rejected")]), (3, [(2.0, "rejected")]), (4, succeeded(3.0, 4.0)))
    miss = missed(accepts, run, "/fibonacci")
    assert (miss.expected, miss.saw) == ("the goal /fibonacci (order=2) at 0 s accepted", "rejected at 1 s")
    assert miss.credit == 0.5
    assert missed(accepts, asked(*[(1, succeeded(0.0, 1.0))] * 3, (2, [])), "/fibonacci").credit == 0.75


def test_a_decision_is_missed_where_there_is_none():
    assert missed(accepts, ran(goals.JudgeRaises, actions.Client), "/fibonacci").saw == "no decision on it"
    asked = ran(misfits.server_that_no_one_spins, actions.Client)
    assert missed(accepts, asked, "/fibonacci").saw == "no server received the goal"


def test_a_decision_needs_someone_who_asks():
    assert missed(accepts, recording(), "/fibonacci").saw == "no server for it"
    both, high = ran(actions.Server, actions.Client), {"where": lambda goal: goal.request.order > 5}
    miss = missed(accepts, both, "/fibonacci", **high)
    assert (miss.expected, miss.saw) == ("goals for /fibonacci that fit", "1, but none like that")
    ends = both.graph.endpoints
    ends[:] = [end._replace(from_course=end.node == "/client") for end in ends]
    with pytest.raises(ValueError, match="nodes of the exercise's own should have sent goals for /fibonacci"):
        accepts(both, "/fibonacci", **high)


def test_finishes_judges_status_time_and_result():
    done = ran(actions.Server, actions.Client)
    assert len(finishes(done, "/fibonacci", "succeeded", fibonacci, within=3.0)) == 1
    assert len(finishes(ran(actions.Aborting, actions.Client), "/fibonacci", "aborted")) == 1


def test_finishes_counts_the_time_from_when_a_goal_was_accepted_but_for_rounding():
    run = asked((3, succeeded(0.1, 0.4)))  # 0.30000000000000004 s
    assert finishes(run, "/fibonacci", within=0.3)
    assert missed(finishes, run, "/fibonacci", within=0.29).saw == "succeeded after 0.3 s"
    assert finishes(asked((3, [(2.0, "succeeded")])), "/fibonacci", within=2.0)


def test_finishes_leaves_open_what_is_not_said():
    assert finishes(asked((3, succeeded(0.0, 9.0))), "/fibonacci")


def test_finishes_names_the_first_goal_that_does_not_and_gives_credit_for_the_others():
    good, late = (1, succeeded(0.0, 1.0)), (2, succeeded(0.0, 3.0))
    later = (3, succeeded(0.0, 4.0))
    miss = missed(finishes, asked(good, late, good, later), "/fibonacci", within=2.0)
    assert (miss.saw, miss.credit) == ("succeeded after 3 s", 0.5)
    assert missed(finishes, asked(good, good, good, late), "/fibonacci", within=2.0).credit == 0.75


def test_finishes_shows_every_wrong_field_of_a_result():
    def right(request):
        return {"error_code": 5, "error_msg": "lost"}

    raw, result = encode(NavigateToPose.Goal()), encode(NavigateToPose.Result(error_code=1, error_msg="none"))
    goal = Goal("/navigate", NAVIGATE, "/client", "00" * 16, raw, 0.0, "/server", list(succeeded(0.0, 1.0)))
    goal.raw_result = result
    miss = missed(finishes, recording(goals=[goal]), "/navigate", "succeeded", right)
    assert miss.expected.startswith("error_code=5, error_msg='lost' as the result of the goal /navigate (")
    assert miss.saw == "error_code=1, error_msg='none'"


def test_finishes_misses_another_end():
    miss = missed(finishes, ran(actions.Forgetful, actions.Client), "/fibonacci", within=3.0)
    assert (miss.expected, miss.saw) == (f"{GOAL} succeeded within 3 s", "aborted at 0 s")
    miss = missed(finishes, ran(goals.Busy, actions.Client), "/fibonacci")
    assert (miss.expected, miss.saw) == (f"{GOAL} succeeded", "still executing at the end")


def test_finishes_misses_an_end_that_comes_late():
    miss = missed(finishes, ran(actions.Server, actions.Client), "/fibonacci", within=2.0)
    assert (miss.expected, miss.saw) == (f"{GOAL} succeeded within 2 s", "succeeded after 3 s")


def test_finishes_misses_a_wrong_result():
    miss = missed(finishes, ran(actions.Coroutine, actions.Client), "/fibonacci", "succeeded", fibonacci)
    assert miss.expected == f"sequence=[0, 1, 1, 2, 3] as the result of {GOAL}"
    assert miss.saw == "sequence=[3]"
    miss = missed(finishes, ran(goals.ReturnsNothing, actions.Client), "/fibonacci", "succeeded", fibonacci)
    assert (miss.expected, miss.saw) == (f"sequence=[0, 1, 1, 2, 3] as the result of {GOAL}", "no result")


def test_gives_feedback_judges_its_rate():
    assert len(gives_feedback(ran(actions.Server, actions.Client), "/fibonacci", 1.0)) == 1


def test_gives_feedback_misses_a_goal_without():
    miss = missed(gives_feedback, ran(goals.IgnoresCancel, actions.Client), "/fibonacci")
    assert (miss.expected, miss.saw) == (f"feedback on {GOAL}", "none")
    assert miss.hint == "In the loop of the execute callback: goal_handle.publish_feedback(feedback)."
    miss = missed(gives_feedback, ran(actions.Server, actions.Greedy), "/fibonacci")
    assert (miss.expected, miss.saw) == ("feedback on a goal for /fibonacci", "no goal was executed")


def test_gives_feedback_misses_another_rate_and_a_pause():
    done = ran(actions.Server, actions.Client)
    miss = missed(gives_feedback, done, "/fibonacci", 2.0)
    assert (miss.expected, miss.saw) == (f"feedback on {GOAL} at 2 Hz, within 10%", "1 Hz (3 messages)")
    miss = missed(gives_feedback, driven(3.0, 2.0, 1.0, end=8.0), "/navigate", 1.0)
    assert miss.saw == "none for 5 s, from 3 s on"
    miss = missed(gives_feedback, driven(3.0), "/navigate", 5.0)
    assert miss.saw == "none for 3 s, from 1 s on"


@pytest.mark.parametrize(("period", "hz"), [(0.5, 2.0), (2.0, 0.5)])
def test_gives_feedback_allows_a_rate_that_is_a_tenth_off_or_as_much_as_is_said(period, hz):
    def feedback(factor):
        return driven(3.0, 2.0, 1.0, period=period / factor, end=4 * period)

    assert gives_feedback(feedback(1.09), "/navigate", hz)
    assert gives_feedback(feedback(0.91), "/navigate", hz)
    expected = f"at {hz:.4g} Hz, within 10%"
    assert missed(gives_feedback, feedback(1.12), "/navigate", hz).expected.endswith(expected)
    assert missed(gives_feedback, feedback(0.88), "/navigate", hz).saw == f"{hz * 0.88:.4g} Hz (3 messages)"
    assert gives_feedback(feedback(1.12), "/navigate", hz, tolerance=0.2)


def test_gives_feedback_takes_any_rate_where_none_is_said():
    assert gives_feedback(driven(3.0, 2.0, period=0.01, end=8.0), "/navigate")


@pytest.mark.parametrize("pause", [2.4, 2.6])
def test_gives_feedback_allows_a_pause_of_two_and_a_half_periods_from_when_it_is_executed(pause):
    first, last = driven(2.0, 1.0, begin=pause - 1.0), driven(2.0, 1.0, end=2.0 + pause)
    first.goals[0].events = [(0.0, "accepted"), (0.0, "executing"), (pause + 2.0, "succeeded")]
    waited = driven(2.0, 1.0, begin=8.0, end=11.0)
    assert gives_feedback(waited, "/navigate", 1.0)
    for waits, since in ((first, 0), (last, 2)):
        if pause < 2.5:
            assert gives_feedback(waits, "/navigate", 1.0)
        else:
            saw = f"none for 2.6 s, from {since} s on"
            assert missed(gives_feedback, waits, "/navigate", 1.0).saw == saw


def test_gives_feedback_misses_a_field_that_should_fall_and_rises():
    rising = driven(1.0, 2.0)
    assert gives_feedback(rising, "/navigate", rising="distance_remaining")
    miss = missed(gives_feedback, rising, "/navigate", falling="distance_remaining")
    assert miss.expected == "distance_remaining only falling in the feedback"
    assert miss.saw == "2.0 after 1.0 at 2 s"


def test_gives_feedback_lets_a_field_go_one_way_only():
    falling = driven(3.0, 2.0, 2.0, 0.5)
    assert len(gives_feedback(falling, "/navigate", falling="distance_remaining")) == 1
    miss = missed(gives_feedback, falling, "/navigate", rising="distance_remaining")
    assert miss.expected == "distance_remaining only rising in the feedback"
    assert miss.saw == "2.0 after 3.0 at 2 s"
    miss = missed(gives_feedback, driven(3.0, math.nan), "/navigate", falling="distance_remaining")
    assert (miss.expected, miss.saw) == (
        "distance_remaining only falling in the feedback", "nan after 3.0 at 2 s",
    )  # fmt: skip


def test_cancels_gives_the_goals_that_were_canceled_in_time():
    (goal,) = cancels(ran(actions.parallel_server, actions.Impatient), "/fibonacci", within=0.5)
    assert goal.status == "canceled"


@pytest.mark.parametrize("server, within, saw", [
    (actions.parallel_server, 0.4, "canceled after 0.5 s"),
    (actions.Server, 1.0, "the request refused at 3 s; succeeded at 3 s"),
    (goals.parallel(goals.IgnoresCancel), 1.0, "succeeded at 3 s"),
    (goals.parallel(goals.AlwaysRejectsCancel), 1.0, "the request refused at 1.5 s; succeeded at 3 s"),
    (goals.parallel(goals.Busy), 1.0, "still canceling at the end"),
    (goals.Busy, 1.0, "still executing at the end"),
], ids=range(6))  # fmt: skip
def test_cancels_misses_what_is_not_canceled(server, within, saw):
    miss = missed(cancels, ran(server, actions.Impatient), "/fibonacci", within=within)
    assert miss.expected == f"{GOAL} canceled within {within:g} s of the request at 1.5 s"
    assert miss.saw == saw


def canceled(after):
    return asked((3, [(0.0, "accepted"), (1.1, "cancel requested"), (1.1 + after, "canceled")]))


def test_cancels_allows_a_second_but_for_rounding():
    assert cancels(canceled(0.99), "/fibonacci")
    assert cancels(asked((3, [(0.1, "cancel requested"), (0.4, "canceled")])), "/fibonacci", within=0.3)
    miss = missed(cancels, canceled(1.01), "/fibonacci")
    assert miss.expected == f"{GOAL} canceled within 1 s of the request at 1.1 s"
    assert miss.saw == "canceled after 1.01 s"


def test_a_goal_that_the_course_should_have_canceled_is_none_of_the_students_misses():
    run = asked((3, succeeded(0.0, 1.0)))
    run.graph.endpoints.append(Endpoint("action client", "/course", "/fibonacci", FIBONACCI, {}, True))
    with pytest.raises(ValueError, match="should have sent goals for /fibonacci that are canceled: none"):
        cancels(run, "/fibonacci")


def test_cancels_needs_someone_who_asks():
    miss = missed(cancels, ran(actions.Server, actions.Client), "/fibonacci")
    assert (miss.expected, miss.saw) == ("goals for /fibonacci that are canceled", "none")


def test_a_long_goal_is_cut_in_words():
    pose = NavigateToPose.Goal()
    goal = Goal("/navigate", NAVIGATE, "/client", "00" * 16, encode(pose), 1.0)
    miss = missed(accepts, recording(goals=[goal]), "/navigate")
    assert miss.expected.startswith("the goal /navigate (pose=geometry_msgs.msg.PoseStamped(")
    assert miss.expected.endswith("...) at 1 s accepted")
