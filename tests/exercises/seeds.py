"""Right nodes with many students' seeds: python -m tests.exercises.seeds 08_joints [EXERCISE ...]"""

from __future__ import annotations

import argparse
import importlib
import sys
from collections.abc import Iterator

from grader import Exercise
from grader.programs import LocalPrograms
from tests.exercises.score_tables import graded_exercises, page, shown, students
from tests.students.teams import programs_of


def right_nodes(topic: str, name: str) -> list[str]:
    """The names of the nodes that earn everything, as the score page says. name: the exercise's."""
    points = exercise_of(topic, name).points
    return [node for node, text in page(topic, name).items() if text == f"{node}: {points:g}"]


def fallen_short(topic: str, name: str, numbers: range) -> Iterator[str]:
    """What a right node misses with these private seeds; they take turns, and most miss nothing."""
    exercise, nodes, right = exercise_of(topic, name), students(topic, name), right_nodes(topic, name)
    for number in numbers:
        node = right[number % len(right)]
        score = exercise.judge(LocalPrograms(programs_of(nodes[node])), f"secret {number}")
        if shown(node, score) != f"{node}: {exercise.points:g}":
            yield f"secret {number}: {shown(node, score)}"


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
    asked = parser.parse_args(words)
    topic = asked.folder.split("_", 1)[1]
    failed = False
    for name in asked.exercises or graded_exercises(asked.folder):
        numbers = range(asked.first, asked.first + asked.count)
        short = list(fallen_short(topic, name, numbers))
        print(f"{name}: {asked.count - len(short)} of {asked.count} earn everything", *short, sep="\n")
        failed |= bool(short)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
