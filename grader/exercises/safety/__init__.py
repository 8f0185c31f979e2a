"""The exercises of 12_safety, from tests that catch mutants to an emergency stop."""

from grader.companions.drivers import Drivers, EmergencyOperator, RoughDriver
from grader.exercises import notebook_names

globals().update(notebook_names(__name__))
