"""Tests of what tries a student's test on programs."""

import threading
import time
from time import sleep

from grader.companions.race_test_runner import MOST_RUNS, VERDICTS, try_test
from sim import explore, run
from tests.patience import PATIENCE

PROGRAM = """\
import rclpy
from rclpy.node import Node


def main():
    started()
    rclpy.init()
    rclpy.spin(Node("{name}"))
"""
ONE, TWO = (["1", PROGRAM.format(name="one")], ["2", PROGRAM.format(name="two")])


def verdicts(test, *sources):
    recording = run(try_test(test, sources or (ONE, TWO)), seconds=1, quiet=True, expect_error=True)
    return [row.message.data for row in recording.messages(VERDICTS)] or [
        error.type for error in recording.errors
    ]


def started(program, order=0):
    return run(program, seconds=0.1, order=order, quiet=True).graph.nodes


def test_a_verdict_says_how_often_a_program_ran_and_why_the_test_failed():
    def fails_on_two(program):
        started(program)
        assert "/two" not in started(program), "it's two"

    assert verdicts(fails_on_two) == ["1 passed 2 0", "2 failed 2 0 it's two"]


def test_any_exception_is_a_failure_and_what_is_returned_is_noted():
    def raises(program):
        raise ValueError("no")

    assert verdicts(raises, ONE) == ["1 failed 0 0 ValueError: no"]
    assert verdicts(lambda program: False, ONE) == ["1 passed 0 0 returned False"]


def test_an_assertion_without_a_text_is_named_by_its_line():
    def fails(program):
        assert program is None

    (verdict,) = verdicts(fails, ONE)
    assert verdict.startswith("1 failed 0 0 assert ")
    assert verdict.endswith(" is None")  # as pytest shows it, which has the value in it, or as it is written


def test_no_further_program_is_tried_after_a_wrong_verdict_on_a_known_one():
    assert verdicts(lambda program: None, [*ONE, "failed"], TWO) == ["1 passed 0 0"]
    assert verdicts(lambda program: None, [*ONE, "passed"], TWO) == ["1 passed 0 0", "2 passed 0 0"]


def test_a_test_that_is_not_written_raises_in_the_run():
    def unwritten(program):
        raise NotImplementedError

    assert verdicts(unwritten) == ["NotImplementedError"]


def test_sleeping_takes_no_time_and_is_counted():
    def sleeps(program):
        time.sleep(100.0)
        sleep(100.0)

    assert verdicts(sleeps, ONE) == ["1 passed 0 2"]
    assert time.sleep is sleep


def test_the_sleep_of_another_thread_is_its_own():
    looked, over = threading.Event(), threading.Event()

    def poll():  # as Jupyter's kernel looks whether its server still runs
        while not over.is_set():
            time.sleep(0.001)
            looked.set()

    def waits(program):
        looked.clear()
        assert looked.wait(PATIENCE)

    poller = threading.Thread(target=poll)
    poller.start()
    try:
        assert verdicts(waits, ONE) == ["1 passed 0 0"]
    finally:
        over.set()
        poller.join(PATIENCE)


def test_a_program_runs_only_so_often():
    def often(program):
        assert [started(program) for _ in range(MOST_RUNS + 2)][-1]

    assert verdicts(often, ONE)[0].startswith(f"1 failed {MOST_RUNS + 2} 0")


def test_explore_ends_with_the_first_order_that_fails():
    def explores(program):
        found = explore(program, holds=lambda recording: not recording.order, orders=50, seconds=0.1)
        assert found.failed is None, f"{found.failed} after {found.tried}"

    assert verdicts(explores, ONE) == ["1 failed 2 0 1 after 1"]
