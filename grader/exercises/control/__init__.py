"""The exercises of 10_control, from measuring a stream to a pole that is pushed."""

from grader.exercises.control.balancing import balance
from grader.exercises.control.marks import marks
from grader.exercises.control.measuring import jitter
from grader.exercises.control.partners import Camera, Marks, Sensor, Slope
from grader.exercises.control.places import (
    hopeless_cart,
    long_track,
    pushed_cart,
    ramp,
    weak_cart,
    work_cart,
)
from grader.exercises.control.pushing import push
from grader.exercises.control.slopes import gap
from grader.exercises.control.working import worker

__all__ = [
    "Camera",
    "Marks",
    "Sensor",
    "Slope",
    "balance",
    "gap",
    "hopeless_cart",
    "jitter",
    "long_track",
    "marks",
    "push",
    "pushed_cart",
    "ramp",
    "weak_cart",
    "work_cart",
    "worker",
]
