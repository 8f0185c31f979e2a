"""The score tables of all assignments through two processes.

python -m tests.exercises.remote [ASSIGNMENT ...]    every node; shows where words or points differ
"""

from __future__ import annotations

import difflib
import importlib
import sys
import time

from grader import Exercise
from grader.programs import RemotePrograms
from grader.workspace import building
from sim.ros.remote import RemoteLost
from tests.exercises.builds import kept_builds
from tests.exercises.score_tables import page, shown, students
from tests.sim.ros.remote.follower_process import FollowerProcess

ASSIGNMENTS = (
    *("nodes", "topics", "services", "settings", "actions", "sensing", "guarding", "navigator", "navigating"),
    *("silence", "joints", "drawing", "frames", "control", "packages", "launching", "testing"),
    *("safety", "lifecycle", "warehouse", "delivery"),
)
# They use random numbers, which differ because the other process must not know the run's seed.
DRAWING = ("OnceOnly", "TooWarm", "Fahrenheit", "DrawnOnceInInit", "ToAndFro")


def exercises() -> list[tuple[str, str]]:
    """The assignment and the name of every exercise that has a table."""
    modules = [(name, importlib.import_module(f"grader.exercises.{name}")) for name in ASSIGNMENTS]
    return [
        (assignment, name)
        for assignment, module in modules
        for name, item in vars(module).items()
        if isinstance(item, Exercise)
    ]


def judge(assignment: str, exercise: str) -> Exercise:
    """The exercise of this name."""
    return getattr(importlib.import_module(f"grader.exercises.{assignment}"), exercise)


def right(assignment: str, exercise: str) -> list[str]:
    """The nodes that earn everything."""
    most = judge(assignment, exercise).points
    return [name for name, text in page(assignment, exercise).items() if text == f"{name}: {most:g}"]


def wrong(assignment: str, exercise: str) -> list[str]:
    """The nodes that miss something and whose page does not depend on random numbers."""
    good = right(assignment, exercise)
    names = [name for name in page(assignment, exercise) if name not in good]
    return [name for name in names if name not in DRAWING]


def earned(follower: FollowerProcess, assignment: str, exercise: str, name: str, secret: str = "") -> str:
    """The score of a node in the other process, in the form of a page."""
    module = f"tests.exercises.{assignment}.{exercise}.students"
    with kept_builds(), follower.serving(module, name, secret=secret) as remote:
        score = judge(assignment, exercise).judge(RemotePrograms(remote, building.build), secret)
    return shown(name, score)


def main() -> None:
    """Compare every node's words with its page."""
    for assignment, exercise in exercises():
        if assignment not in (sys.argv[1:] or ASSIGNMENTS):
            continue
        begin, differing, follower = time.monotonic(), 0, FollowerProcess()
        names = list(students(assignment, exercise))
        for name in names:
            wanted = page(assignment, exercise)[name]
            try:
                found = earned(follower, assignment, exercise, name)
            except RemoteLost as lost:
                found = f"{name}: {lost.reason}"
            if found != wanted:
                differing += 1
                lines = difflib.unified_diff(
                    wanted.splitlines(), found.splitlines(), name, "remote", "", "", 0, ""
                )
                print("\n".join(lines))
        follower.close()
        spent = time.monotonic() - begin
        print(f"{assignment} {exercise}: {len(names)} nodes, {differing} differ, {spent:.1f} s", flush=True)


if __name__ == "__main__":
    main()
