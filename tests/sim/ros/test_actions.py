"""Actions: feedback, results and every status, at exact times."""

import pytest

from sim import run
from tests.sim.ros.evidence import logged, raised
from tests.students.engine import actions

FEEDBACK = [(1.0, "feedback [0, 1, 1]"), (2.0, "feedback [0, 1, 1, 2]"), (3.0, "feedback [0, 1, 1, 2, 3]")]
SUCCESS = [(0.0, "accepted True"), *FEEDBACK, (3.0, "SUCCEEDED [0, 1, 1, 2, 3]")]


def dialogue(*programs):
    return logged(run(*programs, seconds=6, quiet=True))


@pytest.mark.parametrize("server", [actions.Server, actions.parallel_server])
def test_a_goal_gives_feedback_each_second_and_succeeds(server):
    recording = run(server, actions.Client, seconds=6, quiet=True)
    assert logged(recording) == SUCCESS
    assert (recording.errors, recording.stderr) == ([], "")


def test_a_server_with_threads_receives_a_cancel():
    assert dialogue(actions.parallel_server, actions.Impatient) == [
        (0.0, "accepted True"), FEEDBACK[0], (1.5, "canceling 1"), FEEDBACK[1],
        (2.0, "CANCELED [0, 1, 1, 2]"),
    ]  # fmt: skip


def test_a_server_with_one_thread_receives_a_cancel_too_late():
    assert dialogue(actions.Server, actions.Impatient) == [*SUCCESS, (3.0, "canceling 0")]


def test_a_goal_can_be_rejected_or_aborted():
    assert dialogue(actions.Server, actions.Greedy) == [(0.0, "accepted False")]
    assert dialogue(actions.Aborting, actions.Client) == [(0.0, "accepted True"), (1.0, "ABORTED []")]


def test_a_coroutine_can_execute_a_goal():
    assert dialogue(actions.Coroutine, actions.Client) == [(0.0, "accepted True"), (0.0, "SUCCEEDED [3]")]


def test_a_server_that_forgets_to_end_a_goal_is_warned():
    (_, warning), *rest = dialogue(actions.Forgetful, actions.Client)
    assert warning.startswith("Goal state not set, assuming aborted. Goal ID: ")
    assert rest == [(0.0, "accepted True"), (0.0, "ABORTED [1]")]


def test_an_exception_in_execute_is_kept_though_rclpy_goes_on():
    recording = run(actions.Raising, actions.Client, seconds=6, quiet=True)
    assert raised(recording) == [(0.0, "/server", "Raising.execute", "ValueError", "no such number")]
    assert (0.0, "ABORTED []") in logged(recording)
    assert recording.ended.reason == "error"


def test_a_client_in_a_main_waits_line_by_line():
    assert dialogue(actions.Server, actions.waiting_client) == [(2.0, "[0, 1, 1, 2]")]
    assert dialogue(actions.waiting_client, actions.late_server) == [(1.0, "waiting"), (3.75, "[0, 1, 1, 2]")]


def test_send_goal_blocks_main_while_a_thread_spins():
    assert dialogue(actions.Server, actions.blocking_client) == [(2.0, "SUCCEEDED [0, 1, 1, 2]")]


def test_the_graph_names_both_ends():
    ends = run(actions.Server, actions.Client, seconds=1, quiet=True).graph.endpoints
    named = [(end.kind, end.node, end.name, end.type, end.qos) for end in ends if "action" in end.kind]
    assert named == [
        ("action server", "/server", "/fibonacci", "example_interfaces/action/Fibonacci", {}),
        ("action client", "/client", "/fibonacci", "example_interfaces/action/Fibonacci", {}),
    ]
