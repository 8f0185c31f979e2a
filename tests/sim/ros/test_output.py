"""What nodes write: kept by who wrote it, shown on stdout, never on stderr, and nothing is changed after."""

import contextlib
import io
import logging
import os
import subprocess
import sys

import pytest

from sim import run
from tests.patience import PATIENCE
from tests.students.engine import mains, output

pytestmark = pytest.mark.pythons

pytestmark = pytest.mark.filterwarnings("ignore:warned")


def test_each_way_to_write_is_kept_in_its_place(capfd):
    recording = run(output.writes_everywhere, seconds=1)
    assert "".join(text for _, text in recording.prints) == "printed\nwritten\n"
    assert recording.stderr == "complained\nbelow python\n"  # pytest takes the warnings and Python's logging
    assert [tuple(line) for line in recording.logs] == [(0.0, "WARN", "writer", "logged", False)]
    out, err = capfd.readouterr()
    assert err == ""
    assert out.startswith("printed\nwritten\ncomplained\n")
    assert "[WARN] [0.000] [writer]: logged\n" in out


def test_a_quiet_run_shows_nothing(capfd):
    run(output.writes_everywhere, seconds=1, quiet=True)
    assert capfd.readouterr() == ("", "")


def test_levels_are_those_of_ros_and_forgotten_after_the_run(capfd):
    expected = [
        ("INFO", "levels", "info"), ("WARN", "levels", "warning"), ("ERROR", "levels", "error"),
        ("FATAL", "levels", "fatal"), ("DEBUG", "levels", "now"), ("INFO", "levels.part", "child"),
        ("INFO", "other", "not a node's"),
    ]  # fmt: skip
    for _ in range(2):
        recording = run(output.logs_at_every_level, seconds=1, quiet=True)
        assert [(line.level, line.node, line.text) for line in recording.logs] == expected
        assert run(output.logs_debug_lines, seconds=1, quiet=True).logs == []
    assert capfd.readouterr() == ("", "")


def test_texts_of_any_kind_are_kept():
    texts = [line.text for line in run(output.odd_texts, seconds=1, quiet=True).logs]
    assert texts == ["two\nlines", "äöü €", "%s {} \\", "", "a" * 3000]


def test_what_rclpys_logger_refuses_is_an_error_as_on_a_robot():
    (error,) = run(output.logs_a_number, seconds=1, quiet=True).errors
    assert error.type == "TypeError" and "incompatible function arguments" in error.text
    recording = run(output.logs_at_another_level_from_one_line, seconds=1, quiet=True)
    assert [error[3:5] for error in recording.errors] == [
        ("ValueError", "Logger severity cannot be changed between calls.")
    ]


def test_a_programs_own_child_writes_into_the_recording(capfd):
    assert run(output.runs_a_program, seconds=1, quiet=True).stderr == "child\n"
    assert capfd.readouterr() == ("", "")


def test_handlers_made_before_dont_reach_stderr(capfd):
    """A handler of Python's logging that a cell made before the run holds on to sys.stderr."""
    handler, logger = logging.StreamHandler(sys.stderr), logging.getLogger("student")
    logger.addHandler(handler)
    try:
        recording = run(output.writes_everywhere, seconds=1, quiet=True)
        assert recording.stderr == "complained\nlogged by python\nbelow python\n"
        assert capfd.readouterr() == ("", "")
        logger.warning("afterwards")
        assert capfd.readouterr().err == "afterwards\n"
    finally:
        logger.removeHandler(handler)


def test_afterwards_stdout_and_stderr_are_as_before(capfd):
    stdout, stderr, number = sys.stdout, sys.stderr, os.fstat(2).st_ino
    run(output.writes_everywhere, seconds=1, quiet=True)
    assert (sys.stdout, sys.stderr, os.fstat(2).st_ino) == (stdout, stderr, number)
    assert "write" not in vars(stderr)
    os.write(2, b"mine\n")
    print("mine", file=sys.stderr)
    assert capfd.readouterr().err == "mine\nmine\n"


def test_stdout_and_stderr_may_be_led_to_one_place():
    place = io.StringIO()
    with contextlib.redirect_stdout(place), contextlib.redirect_stderr(place):
        recording = run(lambda: print("said"), seconds=1, quiet=True)
        print("afterwards")
    assert "".join(text for _, text in recording.prints) == "said\n"
    assert place.getvalue() == "afterwards\n"


def test_a_whole_process_writes_nothing_to_stderr():
    """From the import to the end of the interpreter: nbgrader takes any text there for a failure."""
    program = (
        "from sim import run\n"
        "from tests.students.engine import errors, output, hangs, threads\n"
        "run(errors.InTimer, threads.queues, world='room', seconds=2, quiet=True)\n"
        "run(hangs.PingPong, seconds=2, quiet=True)\n"
        "recording = run(output.writes_everywhere, seconds=2, quiet=True)\n"
        "print(recording.stderr, end='')\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=PATIENCE)
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    assert lines[:2] == ["complained", "logged by python"]
    assert lines[2].endswith(": UserWarning: warned")
    assert lines[-1] == "below python"


def test_a_kept_reference_to_stdout_is_followed_too(capsys):
    """`print` looks sys.stdout up each time; `file=kept` and handlers of logging do not."""
    kept = sys.stdout

    def main():
        print("straight", file=kept)

    recording = run(main, mains.Counter, seconds=1, quiet=True)
    assert capsys.readouterr().out == ""
    assert "".join(text for _, text in recording.prints) == "straight\n"
    print("after", file=kept)
    assert capsys.readouterr().out == "after\n"


PRINTS_ALWAYS = """
import os, sys, threading
from rclpy.node import Node
from sim import run

class Out:
    def write(self, text): return len(text)
    def flush(self): pass

def haunt():
    while True:
        print("x")

sys.stdout = Out()
threading.Thread(target=haunt, daemon=True).start()
for _ in range(5):
    run(lambda: Node("quiet"), seconds=1)
os._exit(0)
"""


def test_a_thread_that_prints_all_the_time_outlives_runs():
    done = subprocess.run([sys.executable, "-c", PRINTS_ALWAYS], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
