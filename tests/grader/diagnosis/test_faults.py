"""Hangs, livelocks, deadlocks and work that is not started yet, as real runs end with them."""

import re
import threading
from functools import partial

import pytest
from rclpy.node import Node
from std_srvs.srv import Trigger

from grader.diagnosis import find_fault
from grader.diagnosis.fault import Fault
from grader.tell import explain_failure
from sim import Process, run
from sim.evidence import CallbackError, Ended, Recording, place_of
from sim.ros.engine import guard
from tests.students import misfits, mistakes
from tests.students.engine import errors, own_clocks, timing, waitables
from tests.students.service_misfits import Adder, AwaitsInItsGroup


class Flooding(misfits.Talker):
    """Asks and asks, and lets no one answer."""

    def tick(self):
        client = self.create_client(Trigger, "ask")
        while True:
            client.call_async(Trigger.Request())


def fault_of(student):
    return find_fault(run(student, seconds=10, quiet=True))


@pytest.mark.parametrize(
    "student", [misfits.Talker, misfits.main_without_spin, misfits.main_that_only_sleeps]
)
def test_a_run_without_an_error_has_no_fault(student):
    assert fault_of(student) is None


def test_an_endless_loop_is_a_hang():
    fault = fault_of(misfits.main_that_never_ends)
    assert fault.expected == "a run to the end"
    assert fault.saw.startswith("main_that_never_ends() at t = 0 s")
    assert fault.hint == (
        "A main() that loops by itself lets no callback run. To keep a node alive, and let its timers and "
        "subscriptions work, end main() with rclpy.spin(node): it returns only at shutdown."
    )
    assert fault.before_start


@pytest.mark.parametrize("student", [misfits.LoopsInItsConstructor, misfits.LoopsInACallback])
def test_an_endless_loop_of_a_node_differs_from_one_of_a_main(student):
    assert fault_of(student).hint == (
        "Look there for a loop that never ends (`while True:` without a way out), or a wait for something that never happens. A callback should do one small step and return."
    )


def test_an_echo_of_itself_is_a_livelock():
    fault = fault_of(misfits.Echo)
    assert fault.saw == "20000 callbacks ran at t = 1 s without letting time advance."
    assert fault.hint == (
        "Callbacks trigger each other without any time passing: two nodes that answer each other's every message, or a timer with a period of 0. Let a timer with a period set the pace."
    )
    assert not fault.before_start


def test_a_flood_of_messages_differs_from_an_echo():
    fault = fault_of(Flooding)
    assert fault.saw == "/talker sent 20000 messages at t = 1 s without letting time advance."
    assert fault.hint == (
        "A loop publishes again and again without any time passing: let a timer set the pace, or pause in each iteration."
    )


def test_a_call_to_oneself_is_blocked():
    fault = fault_of(misfits.Deadlock)
    assert "/poke" in fault.saw
    assert fault.hint == (
        "Everything waits for something that can't happen. Inside a callback, don't wait for another callback of the "
        "same node (spin_until_future_complete, client.call): use call_async and add_done_callback, or await."
    )


class TakesALockTwice(Node):
    """A lock that its thread already holds."""

    def __init__(self):
        super().__init__("twice")
        self.lock = threading.Lock()
        self.create_timer(0.5, self.tick)

    def tick(self):
        with self.lock:
            self.lock.acquire()


def test_a_callback_that_waits_for_a_lock_is_blocked():
    fault = fault_of(TakesALockTwice)
    assert fault.saw.endswith("never returned, at line 96: self.lock.acquire(). It waits for a lock.")
    assert fault.hint == (
        "That lock is never released: this thread holds it already, or another one that itself waits for a "
        "lock of this thread. Take several locks in the same order everywhere, and hold none while you wait for "
        "something else."
    )


def test_a_callback_that_awaits_a_response_of_its_own_group_is_blocked():
    fault = find_fault(run(Adder, AwaitsInItsGroup, seconds=5, quiet=True))
    assert fault.saw == (
        "AwaitsInItsGroup.tick of node /awaits has waited since t = 0.5 s and never returned. The response of "
        "service /add can only be handled in the same callback group, after it has returned."
    )
    assert fault.hint == (
        "A callback that awaits occupies its callback group until it has returned, and a response is handled in "
        "the client's group. Give the client a group of its own: `callback_group=ReentrantCallbackGroup()`, with "
        "`from rclpy.callback_groups import ReentrantCallbackGroup`."
    )


def test_a_wait_for_something_outside_the_run(monkeypatch):
    monkeypatch.setattr(guard, "WAITING_LIMIT", 0.3)
    fault = fault_of(timing.waits_for_what_a_slow_child_prints)
    assert " waited for 0.3 s in a call that simulated time can't shorten, at line " in fault.saw
    assert fault.hint == (
        "Simulated time stands still during such a wait, so a run has a limit for it. Let the other program take "
        "part in the run, as in run(A, B), or start this one in a terminal."
    )


def test_work_not_started_says_what_is_to_do():
    assert fault_of(mistakes.NotStarted) == Fault(
        expected="your own code instead of `raise NotImplementedError`",
        saw="This exercise is not started yet: publish a count once a second",
        hint="Write your code, delete the line that raises, and run this cell again.",
        before_start=True,
        sentence="There is code to run.",
    )


def test_work_not_started_in_a_callback_counts_as_not_started_too():
    fault = fault_of(mistakes.NotStartedWithoutWords)
    assert fault.before_start
    assert fault.saw == (
        "This exercise is not started yet: there is still a `raise NotImplementedError` in the code"
    )


def test_a_raise_that_was_left_below_the_code_is_not_work_that_is_not_started():
    fault = fault_of(mistakes.LeavesTheRaiseBelowItsCode)
    place = re.search(r"line \d+", fault.saw)[0]
    assert fault.saw == (
        f"Your code is ended by a `raise NotImplementedError` (in LeavesTheRaiseBelowItsCode.tick, {place}, at 1 s)"
    )
    assert fault.hint == "Delete the line that raises, and run this cell again."
    assert not fault.before_start and fault.sentence == "Your code runs without an error."


@pytest.mark.parametrize("program", [own_clocks.Publishes, own_clocks.Overrides, waitables.Ticking])
def test_what_a_run_refuses_is_not_taken_for_work_that_is_not_started(program):
    fault = fault_of(program)
    assert fault.saw.startswith("NotImplementedError: ")
    assert fault.sentence != "There is code to run."


def test_an_error_without_words_and_frames_still_makes_a_sentence():
    recording = Recording(errors=[CallbackError(0.5, "/talker", "Talker.tick", "KeyError", "", "")])
    assert find_fault(recording).saw == "KeyError: no message (in Talker.tick, at 0.5 s)"


@pytest.mark.parametrize(
    ("program", "words"),
    {
        mistakes.RaisesInItsOwnWords: "ValueError: the arm is too far to the left (",
        errors.asks_the_keyboard: "RuntimeError: input() waits for a person at the keyboard; give it lines, ",
        errors.events_executor: "NotImplementedError: EventsExecutor can't run in simulated time. Use Single",
        partial(Process, errors.asks_the_keyboard, stdin=[]): "EOFError: EOF when reading a line (",
        mistakes.MisspellsAFunction: "AttributeError: module 'math' has no attribute 'sine'",
    }.items(),
)
def test_where_the_words_say_enough_there_is_no_hint(program, words):
    recording = run(program, seconds=2, quiet=True)
    assert find_fault(recording).saw.startswith(words)
    (line,) = explain_failure(recording)
    assert line == find_fault(recording).saw


def test_an_error_that_left_nothing_but_its_end_is_reported():
    recording = Recording(ended=Ended("error", 1.0, "A thread died."))
    assert find_fault(recording) == Fault("a run to the end", "A thread died.", "")


def test_an_error_in_a_package_that_was_installed_names_the_line_there():
    file = "/home/ada/ws/install/my_pkg/lib/python3.12/site-packages/my_pkg/talker.py"
    trace = f'  File "{file}", line 12, in tick\n    1 / 0\nZeroDivisionError: division by zero\n'
    assert place_of(
        CallbackError(0.5, "/talker", "Talker.tick", "ZeroDivisionError", "division by zero", trace)
    ) == ("in Talker.tick, line 12, at 0.5 s")


def test_a_wait_for_another_process_is_explained(monkeypatch):
    monkeypatch.setattr(guard, "WAITING_LIMIT", 0.3)
    fault = fault_of(timing.waits_for_a_slow_child)
    assert fault.saw.startswith("waits_for_a_slow_child() at t = 0 s waited for 0.3 s of real time")
    assert fault.hint == (
        "Simulated time stands still during such a wait, so a run has a limit for it. Let the other program take "
        "part in the run, as in run(A, B), or start this one in a terminal."
    )
