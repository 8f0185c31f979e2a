"""The exercises of 11_packages, from a package out of nothing to a broken one."""

from grader.exercises.packages.bench import see
from grader.exercises.packages.defining import crates
from grader.exercises.packages.launching import LANES, convoy
from grader.exercises.packages.making import greeter
from grader.exercises.packages.mending import broken, mended, patrol
from grader.exercises.packages.naming import Weather, station
from grader.exercises.packages.splitting import Probe, gauge

__all__ = [
    "LANES",
    "Probe",
    "Weather",
    "broken",
    "convoy",
    "crates",
    "gauge",
    "greeter",
    "mended",
    "patrol",
    "see",
    "station",
]
