"""The exercises of 04_actions, from a first action server to a square out of actions."""

from grader.exercises.actions.asking import courier, customer
from grader.exercises.actions.partners import Captain, Examiner, Impatient, Mathematician
from grader.exercises.actions.servers import (
    BusyFibonacci,
    CarpetServer,
    DriveServer,
    LateFibonacci,
    SpinServer,
)
from grader.exercises.actions.serving import fibonacci, steps
from grader.exercises.actions.square import square
from grader.exercises.actions.stopping import stoppable
from grader.exercises.actions.turning import turn

__all__ = [
    "BusyFibonacci",
    "Captain",
    "CarpetServer",
    "DriveServer",
    "Examiner",
    "Impatient",
    "LateFibonacci",
    "Mathematician",
    "SpinServer",
    "courier",
    "customer",
    "fibonacci",
    "square",
    "steps",
    "stoppable",
    "turn",
]
