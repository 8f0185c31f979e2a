"""Tasks run in the order in which rclpy's executors run them."""

import pytest

from sim import run
from sim.distro import DISTRO
from tests.sim.ros.evidence import logged
from tests.students.engine import tasks

pytestmark = pytest.mark.pythons


def test_jazzy_runs_the_newest_task_first_and_kilted_the_oldest():
    recording = run(tasks.in_which_order, seconds=3, quiet=True)
    order = ("third", "second", "first") if DISTRO == "jazzy" else ("first", "second", "third")
    assert logged(recording) == [
        *((0.0, f"{name} begins") for name in order),
        *((0.5, f"{name} goes on") for name in order),
    ]


@pytest.mark.parametrize("program", [tasks.PlansInAThread, tasks.plans_with_four_threads])
def test_callbacks_that_await_each_other_and_a_thread_let_time_go_on(program):
    recording = run(program, seconds=3.5, quiet=True)
    assert logged(recording) == [(at, "left, then right") for at in (1.4, 2.4, 3.4)]
