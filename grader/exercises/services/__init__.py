"""The exercises of 03_services, from a service in one line to a mode manager."""

from grader.companions.service_clients import Operator, Pilot, Questioner, Technician, Tuner
from grader.companions.service_servers import Door, RawGyro, SlowAdder, WheelEncoders
from grader.exercises import notebook_names

globals().update(notebook_names(__name__))
