"""The exercises of 03_services, from a service in one line to a cure for a node that freezes."""

from grader.companions.service_clients import Pilot, Questioner, Technician
from grader.companions.service_servers import Door, RawGyro, SlowAdder, WheelEncoders
from grader.exercises import notebook_names

globals().update(notebook_names(__name__))
