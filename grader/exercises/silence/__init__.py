"""The exercises of 07_silence, from a look at the graph to a doctor for silent systems and to tracebacks."""

from grader.companions.crash_reports import crashes
from grader.companions.joystick import SilentJoystick
from grader.companions.latched_map import LatchedMap, LateSubscriber
from grader.companions.radios import RADIO, RadioLidar
from grader.companions.silent_systems import silent_systems
from grader.companions.speakers import speakers
from grader.exercises.silence.crash import crash
from grader.exercises.silence.doctor import doctor
from grader.exercises.silence.graph import graph
from grader.exercises.silence.joystick import joystick
from grader.exercises.silence.late import late
from grader.exercises.silence.lidar import lidar
from grader.exercises.silence.pub import pub
from sim.ros2.cli_program import terminal
