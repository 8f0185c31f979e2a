"""Threads, locks, queues, pools, executors and callback groups: real meaning, simulated time, one order."""

import sys

import pytest
from rclpy.node import Node

from sim import run
from sim.ros.fibers.scheduler import engine
from tests.sim.ros.evidence import logged, times
from tests.students import mistakes
from tests.students.engine import threads

pytestmark = pytest.mark.pythons

CASES = {
    threads.spin_in_a_thread: [(0.5, "tick"), (1.0, "tick"), (1.25, "alive True"), (1.25, "alive False")],
    threads.executor_in_a_thread: [(0.5, "tick"), (1.0, "tick"), (1.25, "alive False")],
    threads.thread_subclass: [
        (0.5, "work 0"), (0.75, "joined for 0.75 s"), (1.0, "work 1"), (1.5, "work 2"), (1.5, "joined"),
    ],
    threads.thread_made_by_the_node: [
        (0.5, "started"), (0.5, "tick"), (1.0, "tick"), (1.5, "tick"), (1.5, "done"), (2.0, "tick"),
    ],
    threads.lock_across_sleeps: [
        (1.0, "a in"), (1.4, "a out"), (1.4, "b in"), (1.7, "b out"), (2.0, "a in"),
    ],
    threads.all_primitives: [
        (0.25, "early False"), (0.5, "event True"), (1.0, "condition True"), (1.5, "semaphore True"),
        (2.0, "barrier"),
    ],
    threads.queues: [(1.25, "did 0")],
    threads.pool: [(1.0, "result 1.0"), (1.0, "result 0.5"), (1.0, "result 0.25"), (1.0, "closed")],
    threads.single_exclusive: [(1.0, "a in"), (1.5, "a out"), (1.5, "b in"), (2.0, "b out"), (2.0, "a in")],
    threads.single_reentrant: [(1.0, "a in"), (1.5, "a out"), (1.5, "b in"), (2.0, "b out"), (2.0, "a in")],
    threads.multi_exclusive: [(1.0, "a in"), (1.5, "a out"), (1.5, "b in"), (2.0, "b out"), (2.0, "a in")],
    threads.multi_reentrant: [
        (1.0, "a in"), (1.0, "b in"), (1.5, "a out"), (1.5, "b out"), (2.0, "a in"), (2.0, "b in"),
    ],
    threads.two_groups_in_parallel: [
        (0.5, "fast"), (1.0, "fast"), (1.5, "fast"), (1.9, "slow"), (2.0, "fast"),
    ],
}  # fmt: skip


@pytest.mark.parametrize("program", CASES, ids=[f"{program.__name__}-{n}" for n, program in enumerate(CASES)])
def test_what_a_program_with_threads_does_until_two_seconds(program):
    recording = run(program, seconds=2, quiet=True)
    assert logged(recording) == CASES[program]
    assert (recording.errors, recording.stderr) == ([], "")


def test_locks_of_every_kind_take_simulated_time():
    assert logged(run(threads.all_primitives, seconds=5, quiet=True))[5:] == [
        (2.1, "rlock at once False"), (2.5, "rlock"), (3.0, "timer"),
    ]  # fmt: skip


def test_a_multi_threaded_executor_runs_no_more_than_its_threads():
    assert logged(run(threads.more_work_than_threads, seconds=3.5, quiet=True)) == [
        (2.5, "a"), (2.5, "b"), (3.0, "c"),
    ]  # fmt: skip


def test_timeouts_of_queues_and_semaphores_are_simulated():
    assert logged(run(threads.queue_timeout, seconds=4, quiet=True)) == [(1.5, "empty")]
    assert logged(run(threads.semaphore_timeout, seconds=4, quiet=True)) == [(1.5, "False"), (3.0, "False")]


@pytest.mark.xfail(strict=True, reason="all fibers are one thread to threading.local")
def test_threads_have_their_own_local_storage():
    assert logged(run(threads.thread_local_storage, seconds=4, quiet=True)) == [
        (0.0, "other has nothing"), (0.25, "main has main"), (0.5, "other has other"),
    ]  # fmt: skip


def test_threads_have_their_own_names():
    assert logged(run(threads.thread_names, seconds=1, quiet=True)) == [(0.0, "worker")]


def test_threads_without_names_have_those_of_a_fresh_program():
    for _ in range(2):
        assert logged(run(threads.names_that_python_gives, seconds=2, quiet=True)) == [
            (0.0, "Thread-1 (work)"), (0.0, "Thread-2 (work)"), (0.0, "ThreadPoolExecutor-0_0"),
            (1.0, "ThreadPoolExecutor-1_0"), (1.25, "ThreadPoolExecutor-1_1"),
            (2.0, "ThreadPoolExecutor-1_0"),
        ]  # fmt: skip


def test_threads_that_wait_when_the_run_ends_are_gone():
    import threading

    before = threading.enumerate()
    recording = run(threads.queues, threads.thread_subclass, seconds=1.1, quiet=True)
    assert times(recording, "work 1") == [1.0]
    assert threading.enumerate() == before


def test_a_program_that_starts_threads_without_end_gets_an_error_soon():
    (error,) = run(mistakes.StartsThreadsWithoutEnd, seconds=2, quiet=True, expect_error=True).errors
    assert (error.stamp, error.callback, error.type) == (0.5, "StartsThreadsWithoutEnd.work", "RuntimeError")
    assert error.text == "can't start new thread: 1000 of this program are running"


@pytest.mark.parametrize("begins", [True, False])
def test_nothing_is_raised_where_a_fiber_begins_or_ends(begins):
    """Nothing catches it there: the run itself would end with our traceback."""
    found = []

    def body():
        frame = sys._getframe(1) if begins else sys._getframe()
        found.append(engine().guard._student_code(frame))

    class Looks(Node):
        def __init__(self):
            super().__init__("looks")
            engine().spawn(body, "looks", engine().current.process)

    run(Looks, seconds=0.1, quiet=True)
    assert [fiber is None for fiber in found] == [begins]
