"""The exercises of 13_delivery, the delivery robot: from the graph on paper to one that drives."""

from grader.checks import questions
from grader.exercises.delivery.deciding import decide
from grader.exercises.delivery.deliver import deliver, programs
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
from grader.exercises.delivery.perceiving import perceive
from grader.exercises.delivery.plan import Camera, hall, hears, says, sketch
from grader.exercises.delivery.planning import blueprint
from grader.exercises.delivery.report import shift_of
from grader.exercises.delivery.sights import crossing, turner
from grader.exercises.delivery.warehouses import warehouse

__all__ = [
    "KEPT",
    "Camera",
    "Floor",
    "blueprint",
    "crossing",
    "decide",
    "deliver",
    "desk",
    "far_from",
    "flat",
    "floor_of",
    "gate",
    "hall",
    "hears",
    "listed",
    "partners",
    "perceive",
    "points_of",
    "programs",
    "questions",
    "says",
    "seconds",
    "shift_of",
    "sketch",
    "stamped",
    "steer",
    "turner",
    "warehouse",
]
