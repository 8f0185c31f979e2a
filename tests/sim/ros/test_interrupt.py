"""The user's interrupt stops a run, whatever the nodes think of it, and reaches the user."""

import os
import signal
import subprocess
import sys
import threading

import pytest

from sim import run
from sim.ros.fibers.scheduler import active
from tests.patience import PATIENCE
from tests.students.engine import interrupts, mains

LONG = 900_000  # simulated seconds: never over while a test waits


@pytest.mark.parametrize("program", [
    interrupts.Busy, interrupts.Swallower, interrupts.SwallowsAll, interrupts.restarts_itself,
    interrupts.cleans_up, interrupts.sleeps,
])  # fmt: skip
def test_an_interrupt_stops_the_run_and_reaches_the_caller(interrupt, program):
    with pytest.raises(KeyboardInterrupt) as caught:
        run(program, world="yard", seconds=LONG, until=interrupt, quiet=True)
    assert str(caught.value) == "The run was interrupted."


def test_an_interrupted_program_cleans_up(interrupt, capsys):
    with pytest.raises(KeyboardInterrupt):
        run(interrupts.cleans_up, seconds=LONG, until=interrupt)
    assert capsys.readouterr().out == "goodbye\n"


def test_the_end_of_a_run_interrupts_the_main_thread_alone(capsys):
    recording = run(interrupts.leaves_threads_behind, seconds=2)
    assert capsys.readouterr() == ("worked\ngoodbye\n", "")
    assert (recording.stderr, recording.errors) == ("", [])


def test_an_interrupt_in_the_goal_stops_the_run():
    with pytest.raises(KeyboardInterrupt):
        run(mains.Counter, seconds=LONG, until=lambda _: os.kill(os.getpid(), signal.SIGINT), quiet=True)
    assert active() is None


def test_an_interrupt_comes_from_another_process_too():
    program = (
        "import os\n"
        "from sim import run\n"
        "from tests.students.engine import interrupts\n"
        "tell = lambda recording: os.write(1, b'It runs.\\n') and False\n"
        "try:\n"
        f"    run(interrupts.SwallowsAll, seconds={LONG}, until=tell, quiet=True)\n"
        "except KeyboardInterrupt as interrupt:\n"
        "    print(interrupt)\n"
    )
    child = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "It runs.\n"
    child.send_signal(signal.SIGINT)
    out, _ = child.communicate(timeout=PATIENCE)
    assert (out.splitlines()[-1], child.returncode) == ("The run was interrupted.", 0)


def test_without_a_run_the_interrupt_is_pythons():
    run(mains.Counter, seconds=1, quiet=True)
    with pytest.raises(KeyboardInterrupt):
        os.kill(os.getpid(), signal.SIGINT)
        threading.Event().wait(PATIENCE)
