"""The exercises of 12b_lifecycle, from diagnostics to a bringup."""

from grader.exercises import notebook_names

globals().update(notebook_names(__name__))
