"""The exercises of 05_sensing, from a stop in one line to a guard between a driver and the robot."""

from grader.companions.blind_drivers import CarelessDriver, Circling, CrashingDriver, LateStarter
from grader.companions.camera import Format, camera
from grader.companions.radios import BadRadio, Radio
from grader.companions.strange_lidar import StrangeLidar
from grader.exercises.sensing.avoid import avoid
from grader.exercises.sensing.bearing import bearing
from grader.exercises.sensing.guard import guard
from grader.exercises.sensing.gyro import gyro
from grader.exercises.sensing.heading import heading
from grader.exercises.sensing.sectors import sectors
from grader.exercises.sensing.stop import stop
from grader.exercises.sensing.wall import wall
from grader.worlds.rooms import furnished_room, gallery, hall, long_hall
