"""What `tell` prints about programs that end in an error on Ctrl-C."""

import re

import pytest

from grader.diagnosis import find_flaw
from sim import run
from tests.students.engine import after_interrupt, mains

FIRST = "On Ctrl-C, rclpy shuts down first, and then main() gets the KeyboardInterrupt: there"
SENTENCES = {
    after_interrupt.shuts_down_again: (
        f"{FIRST} rclpy.shutdown() raises `rcl_shutdown already called` (line N). "
        "Write rclpy.try_shutdown() instead."
    ),
    after_interrupt.publishes_at_the_end: (
        f"{FIRST} publishes_at_the_end ends in RCLError: Failed to publish: publisher's context is invalid "
        "(line N). To publish at the end, begin with "
        "rclpy.init(signal_handler_options=SignalHandlerOptions.NO)."
    ),
    after_interrupt.interrupts_itself: (
        "KeyboardInterrupt came out of interrupts_itself() (line N), which prints a traceback in a terminal. "
        "Spin in a try block with `except KeyboardInterrupt:` below it; a `pass` there is enough."
    ),
    after_interrupt.pauses_at_the_end: (
        "After the Ctrl-C at the end, pauses_at_the_end ends in ValueError: after the pause (line N)."
    ),
}


@pytest.mark.parametrize("program", SENTENCES, ids=lambda program: program.__name__)
def test_an_end_in_an_error_is_named(program):
    recording = run(program, seconds=1, quiet=True)
    assert re.sub(r"line \d+", "line N", find_flaw(recording)) == SENTENCES[program]


@pytest.mark.parametrize("program", [mains.classic, mains.with_finally, mains.Counter, after_interrupt.Impatient])
def test_a_clean_end_and_the_interrupt_itself_are_not(program):
    assert find_flaw(run(program, mains.classic, seconds=1, quiet=True)) == ""
