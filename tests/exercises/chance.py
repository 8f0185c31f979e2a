"""What nodes earn that don't do the work: python -m tests.exercises.chance [EXERCISE ...]

A line for each exercise: its points, those that are given for being there, and what a node earns that answers
nothing, always the same, or by lot. A package is left out: it earns what it was built to do, or nothing.
"""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator, Sequence
from unittest import mock

from grader import Exercise, Score
from grader.catalog import exercises
from grader.programs import LocalPrograms
from tests.exercises.adversaries import adversary
from tests.exercises.assignment import first_run
from tests.exercises.cards import Card
from tests.exercises.evidence import Evidence
from tests.exercises.score_tables import students
from tests.exercises.seeds import exercise_of, right_nodes
from tests.students.teams import programs_of

SECRET = "an instructor's"
BY_LOT = "answers by chance"
BY_CHANCE = "does nothing", "answers constantly", BY_LOT


def for_being_there(exercise: Exercise) -> float:
    """Points of the checks that build on no other: that a node, its topics, its services are there."""
    return sum(check.points for check in exercise.checks if not check.after)


def card_of(topic: str, name: str) -> Card:
    """The public runs of a right node; made once. name: the exercise's in its assignment."""
    right, evidence = right_nodes(topic, name)[0], Evidence.of_nodes(topic)
    with mock.patch("sim.run", evidence.keeping(f"{name}-{right}")):
        score = first_run(exercise_of(topic, name)).grade(*programs_of(students(topic, name)[right]))
    return Card(score.recordings)


def earned(exercise: Exercise, kind: str, program: object) -> Score:
    """The score of a program in a private world; in all of them where it may be lucky in one."""
    judge = exercise if kind == BY_LOT else first_run(exercise)
    evidence = Evidence.of_adversaries(topic_of(exercise))
    with mock.patch("sim.run", evidence.keeping(f"{exercise.name}-{kind}")):
        score = judge.judge(LocalPrograms(programs_of(program)), SECRET)
    assert score.broken == []
    return score


def topic_of(exercise: Exercise) -> str:
    """The assignment of an exercise without its number."""
    return exercise.checks[0].function.__module__.split(".")[2]


def named_exercises(words: Sequence[str] = ()) -> Iterator[tuple[str, str, Exercise]]:
    """Each exercise with its topic and its name in its assignment; only those that are named, if any is."""
    for called, exercise in exercises().items():
        topic = topic_of(exercise)
        names = vars(importlib.import_module(f"grader.exercises.{topic}")).items()
        if not words or called in words:
            yield topic, next(name for name, found in names if found is exercise), exercise


def main(words: list[str]) -> None:
    """Print the table."""
    print(f"{'':20}{'points':>8}{'there':>8}", *(f"{kind:>20}" for kind in BY_CHANCE))
    for topic, name, exercise in named_exercises(words):
        if exercise.package:
            continue
        card = card_of(topic, name)
        shares = [earned(exercise, kind, adversary(kind, card)) / exercise.points for kind in BY_CHANCE]
        begin = f"{exercise.name:20}{exercise.points:8g}{for_being_there(exercise):8g}"
        print(begin, *(f"{100 * share:18.0f} %" for share in shares), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
