"""Loops without a pause let time move on, are the same in every run, and are recorded."""

import functools
import math

import pytest

from sim import Recording, run
from sim.ros.engine import guard
from tests.sim.ros.evidence import logged, values, why
from tests.students.engine import busy_loops, mains

TICKS = [round(0.1 * tick, 1) for tick in range(1, 31)]


@pytest.fixture(autouse=True)
def noticed_soon(monkeypatch):
    monkeypatch.setattr(guard, "COMPUTING_LIMIT", 0.3)


@functools.cache
def usual(program) -> Recording:
    """Its run, for all tests that look at it: a loop costs computing time."""
    return run(program, seconds=3, quiet=True)


@pytest.mark.parametrize("program", [
    busy_loops.LooksInThread, busy_loops.LooksThroughALibrary, busy_loops.SleepsForNoTime,
    busy_loops.Publishes,
])  # fmt: skip
def test_a_loop_in_a_thread_sees_the_flag_when_it_is_set(program):
    recording = usual(program)
    assert logged(recording) == [(1.5, "seen")]
    assert [stamp for stamp, data in values(recording, "/data") if data == 0] == TICKS
    assert why(recording) == ("time", 3.0, "All 3 s were run.")
    (loop,) = recording.busy_loops
    begin = f"thread {program.__name__}.work(), at line "
    assert (loop.stamp, loop.node, loop.place[: len(begin)]) == (0.0, "/busy", begin)


@pytest.mark.parametrize("program", [busy_loops.looks_in_main, busy_loops.spins_without_waiting])
def test_a_loop_in_main_sees_it_too(program):
    recording = run(program, seconds=3, quiet=True)
    assert logged(recording) == [(1.5, "seen")]
    assert why(recording) == ("finished", 2.5, "Every program had ended by t = 1.5 s.")
    (loop,) = recording.busy_loops
    assert loop.place.startswith(f"{program.__name__}(), at line ")


def test_two_loops_do_not_wait_for_each_other():
    assert logged(run(busy_loops.two_that_look, seconds=3, quiet=True)) == [(1.5, "seen")] * 2


def test_the_answer_is_there_when_a_reentrant_callback_looks_for_it():
    recording = usual(busy_loops.asks_for_answers)
    assert logged(recording) == [(1.0, "3"), (2.0, "3"), (3.0, "3")]
    (loop,) = recording.busy_loops
    assert (loop.stamp, loop.node, loop.place[:13]) == (1.0, "/busy", "ask, at line ")


def test_a_loop_without_end_holds_up_no_one_else():
    recording = run(busy_loops.LoopsForEver, mains.Counter, seconds=3, quiet=True)
    assert [stamp for stamp, _ in values(recording, "/data")] == TICKS
    assert [stamp for stamp, _ in values(recording, "/count")] == [0.5, 1.0, 1.5, 2.0, 2.5, 3.0]


@pytest.mark.parametrize("program, began", [
    (busy_loops.Publishes, 0.0), (busy_loops.PublishesInACallback, 1.5),
])  # fmt: skip
def test_a_loop_that_publishes_sends_a_thousand_and_then_one_each_millisecond(program, began):
    recording = usual(program)
    stamps = [stamp for stamp, data in values(recording, "/data") if data == 1]
    later = [pytest.approx(began + 0.001 * number) for number in range(1, 1400)]
    assert stamps[:1001] == [began] * 1001
    assert stamps[1001:2400] == later


@pytest.mark.parametrize("program, lines", [
    (busy_loops.Prints, lambda run: "".join(text for _, text in run.prints).split()),
    (busy_loops.Complains, lambda run: run.stderr.split()),
    (busy_loops.Logs, lambda run: [text for _, text in logged(run)[:-1]]),
], ids=["prints", "complains", "logs"])  # fmt: skip
def test_a_loop_that_talks_takes_time_from_the_five_thousandth_line_on(program, lines, monkeypatch):
    monkeypatch.setattr(guard, "COMPUTING_LIMIT", math.inf)  # or that sees it sooner, on a slow machine
    recording = run(program, seconds=3, quiet=True)
    assert lines(recording) == ["waiting"] * 6_500
    assert logged(recording)[-1][1] == "seen"


@pytest.mark.parametrize("program", [
    busy_loops.LooksInThread, busy_loops.Publishes, busy_loops.asks_for_answers,
])  # fmt: skip
def test_equal_runs_have_equal_digests(program):
    assert run(program, seconds=3, quiet=True).digest == usual(program).digest


def test_equal_runs_of_a_loop_without_end_have_equal_digests():
    first, second = (run(busy_loops.LoopsForEver, seconds=1, quiet=True) for _ in range(2))
    assert first.digest == second.digest


@pytest.mark.parametrize("program, name, stamp", [
    (busy_loops.TenKilohertz, "TenKilohertz", 4.5),
    (busy_loops.sleeps_too_shortly, "sleeps_too_shortly", 1.5),
])  # fmt: skip
def test_a_program_that_does_more_than_rclpy_can_on_a_robot_is_stopped(program, name, stamp):
    recording = run(program, seconds=60, quiet=True)
    reason, ended, detail = why(recording)
    assert (reason, ended) == ("livelock", pytest.approx(stamp, abs=0.06))
    assert detail == (
        f"{name} had more than 5000 callbacks or waits a second, faster than rclpy is on a robot, until "
        f"t = {ended:g} s; a timer's period or a sleep is far too short."
    )


def test_a_kilohertz_is_no_more_than_a_robot_can():
    def node():
        fast = busy_loops.Node("fast")
        fast.publisher = fast.create_publisher(busy_loops.Int32, "data", 10)
        fast.create_timer(0.001, lambda: fast.publisher.publish(busy_loops.Int32()))
        return fast

    recording = run(node, seconds=8, quiet=True)
    assert (recording.ended.reason, len(recording.messages("/data"))) == ("time", 8000)
