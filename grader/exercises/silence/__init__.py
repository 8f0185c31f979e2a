"""The exercises of 07_silence, from a look at the graph to a doctor for six silent systems."""

from grader.exercises.silence.commanding import pub
from grader.exercises.silence.crowd import crowd
from grader.exercises.silence.hearing import lidar
from grader.exercises.silence.joysticks import Joystick
from grader.exercises.silence.latching import late
from grader.exercises.silence.mending import doctor
from grader.exercises.silence.reading import graph
from grader.exercises.silence.senders import RADIO, MapServer, RadioLidar, Visitor
from grader.exercises.silence.stopping import joystick
from grader.exercises.silence.ward import ward
from sim.ros2.cli_program import terminal

__all__ = [
    "RADIO",
    "Joystick",
    "MapServer",
    "RadioLidar",
    "Visitor",
    "crowd",
    "doctor",
    "graph",
    "joystick",
    "late",
    "lidar",
    "pub",
    "terminal",
    "ward",
]
