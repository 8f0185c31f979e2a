"""The exercises of 11_packages, from a package out of nothing to one that is operated in terminals."""

from grader.companions.package_sensors import VoltageProbe, WeatherStation
from grader.exercises import notebook_names
from grader.trial import see

globals().update(notebook_names(__name__))
