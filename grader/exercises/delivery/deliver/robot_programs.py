"""The programs of a delivery robot, as a student's function lists them, and a shift in which they run."""

from collections.abc import Callable, Iterable
from typing import Any

import sim
from grader.worlds.warehouses import warehouse
from sim.evidence import Recording

SHIFT = 150.0  # s of the run


def programs(robot: Callable[[], Iterable[Any]]) -> tuple[Any, ...]:
    """Return the programs of a robot, as `run` and `grade` take them: what the student's function lists.

    Where it fails, it is the program: so its error is shown as any program's.
    """
    try:
        return tuple(robot())
    except Exception:
        return (robot,)


def shift_of(robot: Callable[[], Iterable[Any]], seed: int = 3) -> Recording:
    """Return a shift of the robot of which this function of the student's lists the programs.

    When a notebook is marked, it runs all the same, although `run` is left out there: so its questions are
    shown above the student's answers.
    """
    return sim.run(*programs(robot), world=warehouse("shift", seed), seconds=SHIFT, seed=seed)
