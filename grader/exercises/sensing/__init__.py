"""The exercises of 05_sensing, from a stop in one line to a guard between a driver and the robot."""

from grader.exercises.sensing.driving import avoid, stop
from grader.exercises.sensing.guarding import guard
from grader.exercises.sensing.looking import sectors
from grader.exercises.sensing.partners import (
    BadRadio,
    CarelessDriver,
    Circling,
    CrashingDriver,
    LateStarter,
    Radio,
    StrangeLidar,
)
from grader.exercises.sensing.places import furnished_room, gallery, hall, long_hall
from grader.exercises.sensing.turning import gyro, heading
from grader.exercises.sensing.walls import wall

__all__ = [
    "BadRadio",
    "CarelessDriver",
    "Circling",
    "CrashingDriver",
    "LateStarter",
    "Radio",
    "StrangeLidar",
    "avoid",
    "furnished_room",
    "gallery",
    "guard",
    "gyro",
    "hall",
    "heading",
    "long_hall",
    "sectors",
    "stop",
    "wall",
]
