"""Which packages of the grader stay with the judge: they hold right functions and reference data."""

from pathlib import Path

import grader

EXERCISES = "grader.exercises"  # notebooks import its packages, such as grader.exercises.topics
CLOSED = (
    *("grader.companions", "grader.geometry", "grader.responses", "grader.worlds"),
    "grader.marking.judge",
)
FOLDERS = [Path(grader.__path__[0]).joinpath(*name.split(".")[1:]) for name in (EXERCISES, *CLOSED)]
