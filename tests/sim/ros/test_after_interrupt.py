"""The end of a run is Ctrl-C in the programs' terminals, as rclpy itself handles it."""

import os
import select
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from sim import run
from tests.patience import PATIENCE
from tests.students.engine import after_interrupt

pytestmark = pytest.mark.pythons
# What the programs print as processes of their own, on rclpy 7.1.6 alone, when SIGINT has interrupted them.
FACTS = Path(__file__).with_name("after_interrupt.txt")
LOST = 2.0  # s: an interrupt in a destructor is lost, and repeated
programs = pytest.mark.parametrize("program", after_interrupt.PROGRAMS, ids=lambda program: program.__name__)


def facts():
    """Program to lines."""
    parts = (part.splitlines() for part in FACTS.read_text().split("\n\n"))
    return {name.strip(":"): lines for name, *lines in parts}


def interrupted_process(program):
    """What the program prints as a process that SIGINT interrupts."""
    alone = os.environ | {"ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF", "PYTHONUNBUFFERED": "1"}
    command = [sys.executable, "-m", after_interrupt.__name__, program.__name__]
    process = subprocess.Popen(command, env=alone, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    ready = process.stdout.readline()
    for _ in range(round(PATIENCE / LOST)):
        process.send_signal(signal.SIGINT)
        if select.select([process.stdout], [], [], LOST)[0]:
            break
    return (ready + process.communicate(timeout=PATIENCE)[0]).decode().splitlines()


@programs
def test_after_the_end_the_same_works_as_after_ctrl_c(program, capsys):
    recording = run(program, seconds=0.5)
    shown = [line for line in capsys.readouterr().out.splitlines() if not line.startswith("[")]
    assert shown == facts()[program.__name__]
    assert (recording.errors, recording.end_errors) == ([], [])


@pytest.mark.soak
@programs
def test_the_facts_are_those_of_rclpy(program):
    assert interrupted_process(program) == facts()[program.__name__]


def test_what_leaves_main_after_ctrl_c_is_recorded_and_is_no_error_of_the_run():
    recording = run(after_interrupt.shuts_down_again, seconds=1, quiet=True)
    (error,) = recording.end_errors
    assert (error.stamp, error.node, error.callback) == (1.0, "/counter", "shuts_down_again")
    assert (error.type, error.text) == (
        "RCLError",
        "failed to shutdown: rcl_shutdown already called on the given context",
    )
    assert "rclpy.shutdown()" in error.traceback
    assert (recording.errors, recording.failure, recording.ended.reason) == ([], "", "time")


def test_a_program_has_time_to_end_in_which_the_world_does_not_move():
    recording = run(after_interrupt.pauses_at_the_end, world="room", seconds=1, quiet=True)
    (error,) = recording.end_errors
    assert (error.stamp, error.text) == (2.5, "after the pause")
    assert (recording.stamp, recording.path[-1].stamp) == (1.0, 1.0)


def test_what_main_prints_and_logs_after_ctrl_c_is_shown_and_recorded_apart(capsys):
    recording = run(after_interrupt.says_goodbye, seconds=1)
    assert "".join(text for _, text in recording.end_prints) == "interrupted\n"
    assert [tuple(line) for line in recording.end_logs] == [(1.5, "WARN", "counter", "goodbye", False)]
    assert (recording.prints, recording.logs) == ([], [])
    assert capsys.readouterr().out == "interrupted\n[WARN] [1.500] [counter]: goodbye\n"


def test_a_thread_that_is_ended_by_force_writes_nothing():
    recording = run(after_interrupt.never_ends, seconds=1, quiet=True)
    assert (recording.end_prints, recording.end_logs) == ([], [])


def test_a_program_that_does_not_end_in_time_is_ended_by_force():
    recording = run(after_interrupt.never_ends, seconds=1, quiet=True)
    assert (recording.end_errors, recording.ended.reason) == ([], "time")
