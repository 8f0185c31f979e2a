"""What several exercises of 06_navigator measure: touches, cells, a robot that gets on or doesn't."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from grader.checks import Missed
from sim.evidence import Recording, Seconds

_SHARES = (0.13, 0.37, 0.71, 1.0)  # of a time to look back; uneven, for a circle comes back to its start


def keeps_off(run: Recording, hint: str, expected: str = "no contact with walls or boxes") -> None:
    """The robot touches nothing. Raises Missed with the first touch, and this hint."""
    if run.contacts:
        touch = run.contacts[0]
        saw = f"a {touch.what} touched at {touch.stamp:.3g} s, at ({touch.x:.2f}, {touch.y:.2f}) m"
        raise Missed(expected, saw, hint, picture="path", unsafe=True)


def cells_of(message: Any) -> np.ndarray:
    """The cells of an OccupancyGrid, shape (rows, columns), row 0 is the lowest."""
    return np.array(message.data, dtype=np.int16).reshape(message.info.height, message.info.width)


def tenths(credit: float) -> float:
    """A share of a check's points, from 0 to 1 and in whole tenths, so that points are easy to read."""
    return min(max(math.floor(credit * 10 + 1e-9) / 10, 0.0), 1.0)


def stood_still(run: Recording, seconds: Seconds) -> bool:
    """Whether the robot has not left its place for so long; asked often, so it looks at a few moments."""
    if run.path[-1].stamp < seconds:
        return False
    x, y = run.path[-1][1:3]
    back = [round(len(run.path) / run.path[-1].stamp * seconds * share) for share in _SHARES]
    places = [run.path[max(-1 - steps, -len(run.path))] for steps in back]
    return all(math.dist((x, y), place[1:3]) < 1e-3 for place in places)


def after_a_touch(run: Recording) -> str:
    """Why a robot goes astray that has touched something; nothing where it hasn't."""
    if not run.contacts:
        return ""
    touch = run.contacts[0]
    return f"It drove into a {touch.what} at {touch.stamp:.3g} s, and its odometry has been wrong since."


def is_hopeless(run: Recording, patience: Seconds) -> bool:
    """Whether a run can be ended early: the robot never moves, or it has touched something long ago.

    patience: seconds after a touch in which it may still get on.
    """
    touched = run.contacts and run.stamp > run.contacts[0].stamp + patience
    return bool(touched) or stood_still(run, 20.0)
