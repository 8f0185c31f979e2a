"""The programs of a run are known as long as its recording exists."""

import copy
import gc

from sim import Process, run
from sim.notebook import run_programs as module
from sim.notebook.run_programs import run_programs
from tests.students import misfits


def test_a_run_knows_the_users_programs():
    talker = Process(misfits.Talker, name="other")
    recording = run(talker, misfits.Listener, companions=[misfits.Talker], seconds=0.1, quiet=True)
    assert run_programs(recording) == (misfits.Talker, misfits.Listener)
    assert run_programs(copy.copy(recording)) == ()


def test_they_are_forgotten_with_the_recording():
    recording = run(misfits.Talker, seconds=0.1, quiet=True)
    key = id(recording)
    assert key in module._programs
    del recording
    run(misfits.Listener, seconds=0.1, quiet=True)  # the last run is stored for the ros2 commands
    gc.collect()
    assert misfits.Talker not in module._programs.get(key, ())
