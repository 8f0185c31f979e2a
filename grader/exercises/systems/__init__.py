"""The exercises of 15c_systems: a test that finds races, and six systems to audit."""

from grader.exercises import notebook_names

globals().update(notebook_names(__name__))
