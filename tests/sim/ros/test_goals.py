"""Goals of actions in the recording: every status, feedback and result, at exact times."""

import pytest

from sim import run
from sim.evidence import rate, stamps
from tests.sim.ros.evidence import logged, raised
from tests.students.engine import actions, goals

STARTED = [(0.0, "accepted"), (0.0, "executing")]
ASKED_TO_CANCEL = (1.5, "cancel requested")


def recorded(*programs, seconds=6):
    return run(*programs, seconds=seconds, quiet=True)


def only(*programs, seconds=6):
    (goal,) = recorded(*programs, seconds=seconds).goals
    return goal


def way(goal):
    """(client, server, asked, answered, received)."""
    return goal.client, goal.server, goal.requested, goal.answered, goal.received


@pytest.mark.parametrize("server", [actions.Server, actions.parallel_server])
@pytest.mark.parametrize("client", [actions.Client])
def test_a_goal_has_both_ends_its_stamps_and_all_messages(server, client):
    goal = only(server, client)
    assert (goal.action, goal.type) == ("/fibonacci", "example_interfaces/action/Fibonacci")
    assert way(goal) == ("/client", "/server", 0.0, 0.0, 3.0)
    assert goal.events == [*STARTED, (3.0, "succeeded")]
    assert (goal.status, goal.over) == ("succeeded", True)
    assert (goal.at("succeeded"), goal.at("canceled")) == (3.0, None)
    assert goal.request.order == 3
    assert list(goal.result.sequence) == [0, 1, 1, 2, 3]
    assert len(goal.id) == 32 and int(goal.id, 16)


def test_feedback_is_received_like_a_message():
    feedback = only(actions.Server, actions.Client).feedback
    assert [(h.stamp, list(h.message.sequence)) for h in feedback] == [
        (1.0, [0, 1, 1]), (2.0, [0, 1, 1, 2]), (3.0, [0, 1, 1, 2, 3]),
    ]  # fmt: skip
    assert {(h.topic, h.type, h.sender) for h in feedback} == {
        ("/fibonacci/_action/feedback", "example_interfaces/action/Fibonacci_Feedback", "/server")
    }
    assert rate(stamps(feedback)) == 1.0


@pytest.mark.parametrize("client", [actions.waiting_client, actions.blocking_client])
def test_a_client_may_wait_in_any_way(client):
    assert way(only(actions.Server, client)) == ("/client", "/server", 0.0, 0.0, 2.0)


@pytest.mark.parametrize("programs", [
    (actions.Server, goals.AsksAtOnce), (goals.AsksAtOnce, actions.Server),
], ids=["server first", "client first"])  # fmt: skip
def test_a_goal_before_two_programs_have_found_each_other_is_lost(programs):
    found = recorded(*programs, seconds=1.5).goals
    assert [(goal.requested, goal.answered, goal.status, goal.lost) for goal in found] == [
        (0.0, None, "", True), (1.0, 1.0, "executing", False),
    ]  # fmt: skip


def test_a_cancel_that_is_received_goes_through_canceling():
    goal = only(actions.parallel_server, actions.Impatient)
    assert goal.events == [*STARTED, ASKED_TO_CANCEL, (1.5, "canceling"), (2.0, "canceled")]
    assert list(goal.result.sequence) == [0, 1, 1, 2]


def test_a_cancel_that_comes_too_late_is_rejected():
    goal = only(actions.Server, actions.Impatient)
    assert goal.events == [*STARTED, ASKED_TO_CANCEL, (3.0, "succeeded"), (3.0, "cancel rejected")]
    assert (goal.status, goal.over) == ("succeeded", True)


def test_a_cancel_is_rejected_without_a_callback_for_it():
    goal = only(goals.parallel(goals.AlwaysRejectsCancel), actions.Impatient)
    assert goal.events == [*STARTED, ASKED_TO_CANCEL, (1.5, "cancel rejected"), (3.0, "succeeded")]


def test_a_second_cancel_is_rejected():
    goal = only(actions.parallel_server, goals.CancelsTwice)
    assert goal.events == [
        *STARTED, ASKED_TO_CANCEL, ASKED_TO_CANCEL, (1.5, "canceling"), (1.5, "cancel rejected"),
        (2.0, "canceled"),
    ]  # fmt: skip


def test_a_cancel_that_is_ignored_ends_in_success():
    goal = only(goals.parallel(goals.IgnoresCancel), actions.Impatient)
    assert goal.events == [*STARTED, ASKED_TO_CANCEL, (1.5, "canceling"), (3.0, "succeeded")]


@pytest.mark.parametrize("server, client", [
    (actions.Server, actions.Greedy), (goals.JudgesWithTrue, actions.Client),
])  # fmt: skip
def test_a_goal_can_be_rejected(server, client):
    goal = only(server, client)
    assert way(goal) == ("/client", "/server", 0.0, 0.0, None)
    assert goal.events == [(0.0, "rejected")]
    assert (goal.status, goal.over, goal.result) == ("rejected", True, None)


def test_a_goal_can_be_aborted():
    assert only(actions.Aborting, actions.Client).events == [*STARTED, (1.0, "aborted")]
    assert only(actions.Forgetful, actions.Client).events == [*STARTED, (0.0, "aborted")]


def test_a_goal_can_be_executed_later():
    goal = only(goals.Later, actions.Client)
    assert goal.events == [(0.0, "accepted"), (2.0, "executing"), (5.0, "succeeded")]


def test_a_goal_that_no_one_takes_has_only_been_asked():
    recording = recorded(goals.asks_no_one)
    assert [(way(goal), goal.events) for goal in recording.goals] == [(("/client", "", 0.0, None, None), [])]
    assert recording.goals[0].status == ""


def test_a_client_that_is_not_spun_gets_no_answer():
    assert way(only(actions.Server, goals.never_spins)) == ("/client", "/server", 0.0, None, None)


def test_a_client_need_not_ask_for_the_result():
    goal = only(actions.Server, goals.AsksForNoResult)
    assert way(goal) == ("/client", "/server", 0.0, 0.0, None)
    assert list(goal.result.sequence) == [0, 1, 1, 2, 3]


def test_an_id_that_is_used_again_is_rejected_and_distinguished():
    first, second = recorded(actions.Server, goals.SameIdTwice).goals
    assert first.id == second.id == bytes(range(16)).hex()
    assert (first.request.order, first.events) == (1, [*STARTED, (1.0, "succeeded")])
    assert second.request.order == 2
    assert [word for _, word in second.events] == ["rejected"]


def test_two_servers_make_two_goals_of_one_request():
    recording = recorded(goals.two_servers, actions.Client)
    assert [(goal.server, goal.status) for goal in recording.goals] == [
        ("/one", "succeeded"), ("/two", "succeeded"),
    ]  # fmt: skip
    assert len({goal.id for goal in recording.goals}) == 1


def test_a_goal_sent_past_rclpys_client_has_no_client():
    goal = only(actions.Server, goals.asks_past_the_client)
    assert way(goal) == ("", "/server", None, None, None)
    assert (goal.request.order, goal.status) == (1, "succeeded")


RESULT = "The 'result' field must be a sub message of type 'Fibonacci_Result'"


@pytest.mark.parametrize("server, error, status", [
    (actions.Raising, ("ValueError", "no such number"), "aborted"),
    (goals.ReturnsNothing, ("AssertionError", RESULT), "succeeded"),
    (goals.FeedbackOfAnotherType, ("TypeError", (
        "Expected <class 'example_interfaces.action._fibonacci.Fibonacci_Feedback'>, got <class 'list'>"
    )), "aborted"),
    (goals.JudgeRaises, ("ValueError", "no judgment"), ""),
], ids=lambda value: getattr(value, "__name__", ""))  # fmt: skip
def test_callbacks_that_fail_leave_what_was_done(server, error, status):
    recording = recorded(server, actions.Client)
    assert [tuple(e)[3:5] for e in recording.errors] == [error]
    assert [goal.status for goal in recording.goals] == [status]


def test_a_second_ending_is_refused_and_not_recorded():
    recording = recorded(goals.SucceedsTwice, actions.Client)
    assert recording.goals[0].events == [*STARTED, (0.0, "succeeded")]
    assert recording.errors[0].type == "RCLError"


def test_what_is_no_goal_is_refused_in_words():
    recording = recorded(actions.Server, goals.sends_text)
    words = "Expected <class 'example_interfaces.action._fibonacci.Fibonacci_Goal'>, got <class 'str'>"
    assert logged(recording) == [(0.0, words)]
    assert raised(recording) == [(0.0, "/client", "sends_text", "TypeError", words)]
    assert recording.goals == []


def test_ends_of_the_students_own_classes_work_and_are_recorded():
    goal = only(goals.ServerOfAnOwnClass, goals.ClientOfAnOwnClass)
    assert (way(goal), goal.status) == (("/client", "/server", 0.0, 0.0, 1.0), "succeeded")


def test_a_server_that_is_destroyed_meanwhile_leaves_what_was_done():
    recording = recorded(goals.DestroysItsServer, actions.Client)
    assert (way(recording.goals[0])[3:], recording.goals[0].events) == ((0.0, None), STARTED)


def test_a_goal_before_there_is_a_server_is_lost():
    assert only(goals.asks_no_one, actions.late_server).lost
    assert not only(actions.Server, actions.Client).lost


def test_a_lost_goal_stays_lost_when_its_id_is_used_again():
    lost, taken = recorded(goals.sends_again, actions.late_server).goals
    assert (lost.request.order, lost.lost, lost.server) == (1, True, "")
    assert (taken.request.order, taken.lost, taken.status) == (2, False, "succeeded")


def test_goals_are_found_by_action_client_and_server():
    recording = recorded(actions.Server, actions.Client)
    assert recording.goals_of() == recording.goals_of("/fibonacci") == recording.goals
    assert recording.goals_of(client="/client", server="/server") == recording.goals
    assert recording.goals_of("fibonacci") == recording.goals_of(client="/server") == []
