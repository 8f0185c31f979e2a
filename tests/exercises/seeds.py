"""Right nodes with many students' seeds: python -m tests.exercises.seeds 08_joints [EXERCISE ...]"""

from __future__ import annotations

import argparse
import importlib
import sys
from collections.abc import Iterator
from typing import Any

from grader import Exercise
from grader.programs import LocalPrograms
from tests.exercises.builds import kept_builds
from tests.exercises.reference import solution
from tests.exercises.score_tables import graded_exercises, page, shown, students
from tests.students.teams import programs_of

SOLUTION = "solution"  # the node of the notebook in solutions/


def right_nodes(topic: str, name: str) -> list[str]:
    """The names of the nodes that earn everything, as the score page says. name: the exercise's."""
    points = exercise_of(topic, name).points
    return [node for node, text in page(topic, name).items() if text == f"{node}: {points:g}"]


def fallen_short(topic: str, name: str, numbers: range, node: str = "") -> Iterator[str]:
    """What a right node misses with these private seeds; most miss nothing.

    node: the one that is judged, or SOLUTION; if it is empty, the right nodes take turns.
    """
    exercise, right = exercise_of(topic, name), [node] if node else right_nodes(topic, name)
    programs = [programs_named(topic, name, one) for one in right]
    for number in numbers:
        turn = number % len(right)
        node, score = right[turn], exercise.judge(LocalPrograms(programs[turn]), f"secret {number}")
        if shown(node, score) != f"{node}: {exercise.points:g}":
            yield f"secret {number}: {shown(node, score)}"


def programs_named(topic: str, name: str, node: str) -> tuple[Any, ...]:
    """The programs of a node of an exercise's module, or the SOLUTION, as `grade` takes them."""
    return solution(topic, name) if node == SOLUTION else programs_of(students(topic, name)[node])


def exercise_of(topic: str, name: str) -> Exercise:
    """The exercise that has this name in its assignment: another one may have one of the same name."""
    return getattr(importlib.import_module(f"grader.exercises.{topic}"), name)


def main(words: list[str]) -> int:
    """Judge all or some exercises of an assignment; the exit status says whether any node fell short."""
    parser = argparse.ArgumentParser(prog="python -m tests.exercises.seeds", description=__doc__)
    parser.add_argument("folder", help="an assignment's folder in solutions/, such as 08_joints")
    parser.add_argument("exercises", nargs="*", help="their names; all of them where none is given")
    parser.add_argument("--count", type=int, default=200, help="how many seeds each")
    parser.add_argument("--first", type=int, default=0, help="the first one's number")
    parser.add_argument("--node", default="", help=f"only this node, or {SOLUTION!r}: that of the notebook")
    asked = parser.parse_args(words)
    topic = asked.folder.split("_", 1)[1]
    failed = False
    numbers = range(asked.first, asked.first + asked.count)
    with kept_builds():
        for name in asked.exercises or graded_exercises(asked.folder):
            short = list(fallen_short(topic, name, numbers, asked.node))
            print(f"{name}: {asked.count - len(short)} of {asked.count} earn everything", *short, sep="\n")
            failed |= bool(short)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
