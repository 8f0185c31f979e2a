"""The exercises of 13_delivery, the delivery robot: from the graph on paper to one that drives."""

from grader.exercises.delivery.deciding import decide
from grader.exercises.delivery.desk import desk
from grader.exercises.delivery.floor import (
    KEPT,
    Floor,
    far_from,
    flat,
    listed,
    points_of,
    seconds,
    stamped,
    steer,
)
from grader.exercises.delivery.gating import gate
from grader.exercises.delivery.partners import floor_of, partners

__all__ = [
    "KEPT",
    "Floor",
    "decide",
    "desk",
    "far_from",
    "flat",
    "floor_of",
    "gate",
    "listed",
    "partners",
    "points_of",
    "seconds",
    "stamped",
    "steer",
]
