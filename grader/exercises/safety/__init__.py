"""The exercises of 12_safety, from tests that catch mutants to diagnostics."""

from grader.companions.battery_and_motor import BatteryAndMotor
from grader.companions.bench import bench
from grader.companions.drivers import Drivers, EmergencyOperator, RoughDriver
from grader.companions.workshop import workshop
from grader.exercises.safety.health import health
from grader.exercises.safety.latch import latch
from grader.exercises.safety.mutants import mutants
from grader.exercises.safety.mux import mux
from grader.exercises.safety.smooth import smooth
