"""The exercises of 11c_testing: tests of a node and of a launch file, and a program in the wrong folder."""

from grader.exercises import notebook_names
from grader.trial import see

globals().update(notebook_names(__name__))
