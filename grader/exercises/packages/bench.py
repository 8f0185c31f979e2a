"""Tries a package as its exercise does, in a notebook."""

from __future__ import annotations

import os

from grader.cast import LocalCast
from grader.diagnosis.fault import NOT_STARTED, Fault
from grader.exercise import Exercise
from grader.tell import BEGIN, tell
from grader.workspace.building import NotHere
from sim.evidence import Recording


def see(exercise: Exercise, workspace: str | os.PathLike[str] | None, scenario: int = 0) -> Recording:
    """Build the package of an exercise anew, and run one of its scenarios.

    workspace: the folder with src/ in it. What goes wrong is printed; the recording of a package that can't
    be built is empty. No points are given.
    """
    cast = LocalCast((workspace,))
    try:
        found = cast.package(exercise.package)
        if isinstance(found, Fault):
            print(BEGIN if found.sentence == NOT_STARTED else f"{found.saw}\nHint: {found.hint}")
            return Recording()
        chosen, seed = exercise.runs()[scenario]
        recording = chosen.run(cast, seed)
        tell(recording)
        return recording
    except NotHere:
        print("Here nothing can be built: when a class is marked, the test cell below does it.")
        return Recording()
    finally:
        cast.leave()
