"""Model answers in the variants of students: python -m tests.exercises.variants 02_topics [EXERCISE ...]"""

from __future__ import annotations

import argparse
import functools
import sys
from collections.abc import Iterator
from pathlib import Path

import nbformat

from grader import Exercise, Score
from grader.marking.judge.personal_release import varied_exercises
from grader.programs import LocalPrograms
from grader.seeds import secret_of_student
from grader.variants import Variants, drawn_number
from tests.exercises.reference import solution
from tests.exercises.score_tables import ROOT, graded_exercises
from tests.exercises.seeds import exercise_of

STUDENT = "alice"


@functools.cache
def folders() -> list[str]:
    """The assignments with exercises that have variants."""
    paths = sorted(ROOT.glob("solutions/*/*.ipynb"))
    return [path.parent.name for path in paths if varied_exercises(nbformat.read(path, 4))]


def varied(folder: str) -> list[str]:
    """The names of an assignment's exercises that have variants, as its notebook has them."""
    topic = topic_of(folder)
    return [name for name in graded_exercises(folder) if exercise_of(topic, name).variants]


def topic_of(folder: str) -> str:
    """The name of an assignment without its number."""
    return folder.split("_", 1)[1]


def notebook_of(folder: str, place: str = "solutions") -> Path:
    """The notebook of an assignment."""
    (path,) = (ROOT / place / folder).glob("*.ipynb")
    return path


def variants_of(exercise: Exercise) -> Variants:
    """Those that it has."""
    assert exercise.variants is not None
    return exercise.variants


def telling(variants: Variants) -> list[int]:
    """The numbers of a few variants in which every value is at least once, the first one included."""
    rows = [{*variants.values(number).items()} for number in range(variants.count)]
    found, left = [0], set().union(*rows) - rows[0]
    while left:
        found.append(max(range(variants.count), key=lambda number: len(rows[number] & left)))
        left -= rows[found[-1]]
    return found


def judged(topic: str, name: str, number: int, secret: str = "", copied: int | None = None) -> Score:
    """What the model answer of a variant earns in it. copied: the variant whose answer it is, if another."""
    exercise = exercise_of(topic, name).variant(number)
    return exercise.judge(LocalPrograms(solution(topic, name, number, copied)), secret)


def fallen_short(folder: str, name: str, secrets: range) -> Iterator[str]:
    """The secrets with which a student's model answer doesn't earn everything, and what it misses."""
    topic = topic_of(folder)
    exercise = exercise_of(topic, name)
    for each in secrets:
        own = secret_of_student(f"secret {each}", STUDENT)
        number = drawn_number(own, exercise.name, variants_of(exercise).count)
        score = judged(topic, name, number, own)
        if float(score) != exercise.points:
            missed = [f"{it.sentence} Saw: {it.saw}" for it in score.verdicts if it.status != "passed"]
            yield f"secret {each}, variant {number}: {float(score):g} of {exercise.points:g}: {missed}"


def main(words: list[str]) -> int:
    """Judge model answers with many secrets; the exit status says whether any fell short."""
    parser = argparse.ArgumentParser(prog="python -m tests.exercises.variants", description=__doc__)
    parser.add_argument("folder", help="an assignment's folder in solutions/, such as 02_topics")
    parser.add_argument("exercises", nargs="*", help="their names; all with variants where none is given")
    parser.add_argument("--count", type=int, default=200, help="how many secrets")
    parser.add_argument("--first", type=int, default=0, help="the first one's number")
    asked = parser.parse_args(words)
    failed = False
    for name in asked.exercises or varied(asked.folder):
        short = list(fallen_short(asked.folder, name, range(asked.first, asked.first + asked.count)))
        print(f"{name}: {asked.count - len(short)} of {asked.count} full", *short, sep="\n", flush=True)
        failed |= bool(short)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
