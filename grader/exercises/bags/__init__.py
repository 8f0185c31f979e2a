"""The exercises of 14_bags: what a bag says about a robot, and what is wrong with it."""

from grader.exercises import notebook_names

globals().update(notebook_names(__name__))
