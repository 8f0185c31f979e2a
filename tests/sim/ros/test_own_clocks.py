"""Only the engine sets the time of a run: a program that tries gets an error."""

import pytest

from sim import run
from tests.sim.ros.evidence import raised
from tests.students.engine import own_clocks

NOT_HERE = "can't change the time in a run: all clocks show its simulated time."


@pytest.mark.parametrize(
    ("program", "node", "words"),
    [
        (own_clocks.Publishes, "/publishes", f"Messages on /clock {NOT_HERE}"),
        (own_clocks.Overrides, "/overrides", f"set_ros_time_override() {NOT_HERE}"),
    ],
)
def test_a_program_can_not_set_the_time(program, node, words):
    recording = run(program, seconds=1, quiet=True)
    assert raised(recording) == [(0.0, node, program.__name__, "NotImplementedError", words)]
