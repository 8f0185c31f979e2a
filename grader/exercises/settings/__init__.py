"""The exercises of 03b_settings: parameters, a mode manager, and a program from ROS 1."""

from grader.companions.service_clients import Operator, Tuner
from grader.exercises import notebook_names

globals().update(notebook_names(__name__))
