"""Whole programs run unmodified: the same ticks, at the same times, whatever shape main() has."""

import pytest

from sim import run
from tests.sim.ros.evidence import logged, values, why
from tests.students.engine import mains

pytestmark = pytest.mark.pythons

TICKS = [(0.5, 1), (1.0, 2), (1.5, 3), (2.0, 4), (2.5, 5), (3.0, 6)]
FOREVER = [
    mains.Counter, mains.classic, mains.with_finally, mains.bound_early, mains.with_arguments_of_its_own,
    mains.own_executor, mains.spin_once_loop, mains.only_a_node, mains.makes_one_with_init,
]  # fmt: skip


@pytest.mark.parametrize("program", FOREVER, ids=lambda program: program.__name__)
def test_a_program_that_spins_ticks_until_time_is_up(program):
    recording = run(program, seconds=3, quiet=True)
    assert values(recording, "/count") == TICKS
    assert why(recording) == ("time", 3.0, "All 3 s were run.")
    assert (recording.errors, recording.stderr, recording.stamp) == ([], "", 3.0)


def test_programs_run_side_by_side_in_the_order_they_were_given():
    recording = run(mains.classic, mains.own_context, mains.with_arguments_of_its_own, seconds=1, quiet=True)
    senders = [(received.stamp, received.sender) for received in recording.messages("/count")]
    assert senders == [
        (0.5, "/counter"),
        (0.5, "/renamed"),
        (1.0, "/counter"),
        (1.0, "/own"),
        (1.0, "/renamed"),
    ]
    assert recording.graph.nodes == ["/counter", "/own", "/renamed"]


def test_one_program_may_be_run_twice_at_once():
    recording = run(mains.classic, mains.classic, seconds=1, quiet=True)
    assert values(recording, "/count") == [(0.5, 1), (0.5, 1), (1.0, 2), (1.0, 2)]


def test_two_nodes_in_one_executor_take_turns_in_the_order_they_were_added():
    received = run(mains.two_nodes_one_executor, seconds=1, quiet=True).messages("/count")
    assert [(h.stamp, h.sender, h.message.data) for h in received] == [
        (0.5, "/first", 1), (0.5, "/second", 1), (1.0, "/first", 2), (1.0, "/second", 2),
    ]  # fmt: skip


def test_spin_once_waits_for_its_timeout():
    recording = run(mains.spin_once_with_timeout, seconds=9, quiet=True)
    assert values(recording, "/count") == [(0.25 * count, count) for count in range(12)]
    assert why(recording) == ("finished", 4.0, "Every program had ended by t = 3 s.")


def test_polling_loops_take_time():
    polling = run(mains.spin_once_polling, seconds=9, quiet=True)
    assert values(polling, "/count") == TICKS[:3]
    busy = run(mains.busy_ok_loop, seconds=9, quiet=True)
    assert [text for _, text in logged(busy)] == ["two seconds are over"]
    assert logged(busy)[0][0] == pytest.approx(2.0, abs=0.002)


def test_a_node_may_shut_rclpy_down_and_end():
    recording = run(mains.shuts_itself_down, seconds=9, quiet=True)
    assert values(recording, "/count") == TICKS[:3]
    assert logged(recording) == [(1.75, "enough")]
    assert why(recording) == ("finished", 2.75, "Every program had ended by t = 1.75 s.")


def test_system_exit_leaves_spin_and_may_be_caught():
    recording = run(mains.raises_to_leave_spin, seconds=9, quiet=True)
    assert logged(recording) == [(1.25, "done")]
    assert why(recording) == ("finished", 2.25, "Every program had ended by t = 1.25 s.")


def test_a_program_may_start_rclpy_again():
    received = run(mains.init_again, seconds=9, quiet=True).messages("/count")
    assert [(h.stamp, h.sender, h.message.data) for h in received] == [
        (0.5, "/one", 1), (1.0, "/one", 2), (1.5, "/two", 1), (2.0, "/two", 2),
    ]  # fmt: skip


def test_a_program_may_have_a_context_of_its_own():
    recording = run(mains.own_context, seconds=3, quiet=True)
    assert values(recording, "/count") == [(1.0, 7), (2.0, 7), (3.0, 7)]
    assert recording.errors == []
