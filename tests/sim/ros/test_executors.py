"""Executors of the student's own wait in simulated time, and their callbacks are in the recording."""

from sim import run
from tests.sim.ros.evidence import logged, raised, why
from tests.students.engine import executors


def lines(recording):
    return [(line.stamp, line.node, line.text) for line in recording.logs]


def test_an_executor_that_runs_each_callback_itself_spins_as_rclpys_do():
    recording = run(executors.one_by_one, seconds=1.2, quiet=True)
    assert logged(recording) == [(0.5, "tick"), (0.5, "received"), (1.0, "tick"), (1.0, "received")]
    assert [(ran.callback, ran.kind) for ran in recording.callbacks] == [
        ("Ticking.tick", "timer"), ("Ticking.on_message", "subscription"),
    ] * 2  # fmt: skip


def test_an_executor_may_hand_callbacks_to_pools_of_its_own():
    recording = run(executors.priorities, seconds=1.3, quiet=True)
    received = [line for line in lines(recording) if line[2] == "tick"]
    assert received == [(0.5, "urgent", "tick"), (1.0, "urgent", "tick"), (1.2, "patient", "tick")]
    assert why(recording) == ("time", 1.3, "All 1.3 s were run.")


def test_what_a_callback_raises_leaves_spin():
    recording = run(executors.raises, seconds=2, quiet=True)
    assert raised(recording) == [(0.5, "/raising", "<lambda>", "ZeroDivisionError", "division by zero")]


def test_waiting_for_callbacks_ends_as_rclpys_does():
    assert logged(run(executors.all_ends, seconds=3, quiet=True)) == [
        (0.25, "TimeoutException"), (0.25, "TimeoutException"), (1.0, "TimeoutException"),
        (1.0, "ConditionReachedException"), (1.0, "ShutdownException"), (1.0, "ExternalShutdownException"),
    ]  # fmt: skip


def test_spin_once_begins_with_the_first_entity_when_its_timeout_is_another():
    assert [text for _, text in logged(run(executors.spins_once_each_time, seconds=3, quiet=True))] == [
        "first", "first", "first", "first", "second", "first",
    ]  # fmt: skip
