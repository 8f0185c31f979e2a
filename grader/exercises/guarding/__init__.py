"""The exercises of 05b_guarding: a heading, and a guard between a driver and the robot."""

from grader.companions.blind_drivers import CarelessDriver, Circling, CrashingDriver, LateStarter
from grader.companions.radios import BadRadio, Radio
from grader.exercises import notebook_names
from grader.worlds.rooms import furnished_room, gallery, long_hall

globals().update(notebook_names(__name__))
