"""The exercises of 12_safety, from tests that catch mutants to diagnostics."""

from grader.exercises.safety.bench import bench, workshop
from grader.exercises.safety.choosing import mux
from grader.exercises.safety.latching import latch
from grader.exercises.safety.partners import Drivers, Operator, Patient, Rough
from grader.exercises.safety.reporting import health
from grader.exercises.safety.smoothing import smooth
from grader.exercises.safety.testing import mutants

__all__ = [
    "Drivers",
    "Operator",
    "Patient",
    "Rough",
    "bench",
    "health",
    "latch",
    "mutants",
    "mux",
    "smooth",
    "workshop",
]
