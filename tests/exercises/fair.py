"""Seeds in which good robots do their work: python -m tests.exercises.fair 13_delivery deliver --first 10

A warehouse drawn by chance may lie so that nobody can do what a scenario asks for. For each seed the
solution's notebook and all right nodes are run in all scenarios of an exercise; where none of them misses
anything it is fair.
"""

from __future__ import annotations

import argparse
import copy
import importlib
import sys
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import nbformat

from grader import Exercise
from grader.checks import Missed
from grader.programs import LocalPrograms
from tests.exercises.score_tables import GRADES, ROOT, students
from tests.exercises.seeds import right_nodes
from tests.students.teams import programs_of


def solution(folder: str, name: str) -> tuple[Any, ...]:
    """What the notebook in solutions/ gives to an exercise, as `grade` takes it."""
    (path,) = (ROOT / "solutions" / folder).glob("*.ipynb")
    space: dict[str, Any] = {"given": lambda *nodes: nodes}
    for cell in nbformat.read(path, 4).cells:
        graded = GRADES.fullmatch(cell.source)
        if graded and graded[1] == name:
            return tuple(eval(f"given({graded[2]})", space))
        if not graded and (cell.source.startswith(("import ", "from ")) or "BEGIN SOLUTION" in cell.source):
            exec(cell.source, space)
    raise ValueError(f"{path} grades no {name}")


def unfair(exercise: Exercise, programs: tuple[Any, ...], seed: int) -> set[str]:
    """The names of the scenarios in which these programs miss something with this seed."""
    tried = copy.copy(exercise)
    tried.scenarios = [replace(scenario, seed=seed) for scenario in exercise.scenarios]
    score = tried.judge(LocalPrograms(programs))
    missed = {verdict.run for verdict in score.verdicts if verdict.status != "passed"}
    everywhere = [check for check in exercise.checks if not check.only]  # a verdict names the first run alone
    for run, recording in enumerate(score.recordings):
        missed |= {run for check in everywhere if _is_missed(check, recording)}
    return {exercise.scenarios[run].name for run in missed}


def _is_missed(check: Any, recording: Any) -> bool:
    try:
        check(recording)
    except Missed:
        return True
    return False


def fair(folder: str, name: str, numbers: range) -> Iterator[tuple[int, set[str]]]:
    """Each seed with the scenarios in which somebody missed something."""
    topic = folder.split("_", 1)[1]
    exercise = getattr(importlib.import_module(f"grader.exercises.{topic}"), name)
    robots = [programs_of(students(topic, name)[node]) for node in right_nodes(topic, name)]
    for number in numbers:
        missed = [unfair(exercise, robot, number) for robot in (solution(folder, name), *robots)]
        yield number, set().union(*missed)


def main(words: list[str]) -> None:
    """Print each seed as it is tried, and at the end the fair ones of each scenario."""
    parser = argparse.ArgumentParser(prog="python -m tests.exercises.fair", description=__doc__)
    parser.add_argument("folder", help="an assignment's folder in solutions/, such as 13_delivery")
    parser.add_argument("exercise", help="the name of one with scenarios")
    parser.add_argument("--count", type=int, default=20, help="how many seeds")
    parser.add_argument("--first", type=int, default=10, help="the first one")
    asked = parser.parse_args(words)
    tried = []
    for number, missed in fair(asked.folder, asked.exercise, range(asked.first, asked.first + asked.count)):
        tried.append((number, missed))
        print(number, "unfair:", ", ".join(sorted(missed)) or "none", flush=True)
    module = importlib.import_module(f"grader.exercises.{asked.folder.split('_', 1)[1]}")
    for scenario in getattr(module, asked.exercise).scenarios:
        print(scenario.name, *(number for number, missed in tried if scenario.name not in missed))


if __name__ == "__main__":
    main(sys.argv[1:])
