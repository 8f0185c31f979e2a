"""Recognizes runs that answer another variant of an exercise than the student's own."""

from __future__ import annotations

from grader.checks.verdicts import judge, worst
from grader.exercise import Exercise
from grader.score import Score

ANSWERED = (
    "its nodes answer another variant of the task ({}), as other students may have it, and would earn all "
    "points there; this student's own ({}) counts"
)


def answered_variants(exercise: Exercise, score: Score) -> list[str]:
    """Return a phrase about the first other variant that the same runs earn all points in, if there is one.

    score: of this exercise. Nothing is run again: the recordings are judged by the checks of the others.
    """
    variants = exercise.variants
    if variants is None or float(score) == score.max:
        return []
    others = (number for number in range(variants.count) if number != exercise.number)
    found = next((number for number in others if _earns_everything(exercise.variant(number), score)), None)
    if found is None:
        return []
    return [ANSWERED.format(variants.describe(found), variants.describe(exercise.number))]


def _earns_everything(other: Exercise, score: Score) -> bool:
    scenarios = [scenario.name for scenario, _ in other.runs()]
    with other.in_use():
        judged = [
            judge(other.checks, recording, name, may_end=other.may_end)
            for name, recording in zip(scenarios, score.recordings, strict=False)
        ]
    again = Score(other.name, worst(other.checks, judged))
    return len(judged) == len(scenarios) and float(again) == again.max > 0
