"""The exercises of 15b_threads: callback groups, commands over a bad network, and a deadlock."""

from grader.exercises import notebook_names

globals().update(notebook_names(__name__))
