"""The exercises of 03_services, from a service in one line to a mode manager."""

from grader.companions.engine_sensor import engine
from grader.companions.service_clients import Operator, Pilot, Questioner, Technician, Tuner
from grader.companions.service_servers import Door, RawGyro, SlowAdder, WheelEncoders
from grader.exercises.services.add import add
from grader.exercises.services.arming import arming
from grader.exercises.services.calibrate import calibrate
from grader.exercises.services.door import door
from grader.exercises.services.modes import modes
from grader.exercises.services.parameters import launch, parameters
from grader.exercises.services.port import port
from grader.exercises.services.ticks import ticks
