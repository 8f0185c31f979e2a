"""What the report of 13_delivery is about: a shift of the student's robot, which asks questions."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from grader.exercises.delivery.deliver import SHIFT, programs
from grader.exercises.delivery.warehouses import warehouse
from sim import run
from sim.evidence import Recording


def shift_of(robot: Callable[[], Iterable[Any]], seed: int = 3) -> Recording:
    """A shift of the robot of which this function of the student's lists the programs.

    For marking, too, a notebook runs it where `run` would be left out: so its questions stand above the
    student's answers, for whoever reads them.
    """
    return run(*programs(robot), world=warehouse("shift", seed), seconds=SHIFT, seed=seed)
