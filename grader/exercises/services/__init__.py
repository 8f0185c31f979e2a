"""The exercises of 03_services, from a service in one line to a mode manager."""

from grader.exercises.services.answering import add, calibrate
from grader.exercises.services.arming import arming
from grader.exercises.services.asking import door, ticks
from grader.exercises.services.modes import modes
from grader.exercises.services.partners import Operator, Pilot, Questioner, RawGyro, Technician, Tuner
from grader.exercises.services.servers import Door, SlowAdder, Wheels
from grader.exercises.services.settings import launch, parameters

__all__ = [
    "Door",
    "Operator",
    "Pilot",
    "Questioner",
    "RawGyro",
    "SlowAdder",
    "Technician",
    "Tuner",
    "Wheels",
    "add",
    "arming",
    "calibrate",
    "door",
    "launch",
    "modes",
    "parameters",
    "ticks",
]
