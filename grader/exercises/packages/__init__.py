"""The exercises of 11_packages, from a package out of nothing to a broken one."""

from grader.companions.odometer_package import rearranged
from grader.companions.package_sensors import VoltageProbe, WeatherStation
from grader.companions.patrol_package import repaired
from grader.companions.watchman_package import write_watchman
from grader.exercises.packages.convoy import LANES, convoy
from grader.exercises.packages.crates import crates
from grader.exercises.packages.gauge import gauge
from grader.exercises.packages.greeter import greeter
from grader.exercises.packages.keeper import keeper
from grader.exercises.packages.launch_test import launch_test
from grader.exercises.packages.limiter import limiter
from grader.exercises.packages.odometer import odometer
from grader.exercises.packages.patrol import patrol
from grader.exercises.packages.session import session
from grader.exercises.packages.station import station
from grader.trial import see

__all__ = [
    "LANES", "VoltageProbe", "WeatherStation", "convoy", "crates", "gauge", "greeter", "keeper",
    "launch_test", "limiter", "odometer", "patrol", "rearranged", "repaired", "see", "session", "station",
    "write_watchman",
]
