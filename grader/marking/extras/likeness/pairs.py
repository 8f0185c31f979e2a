"""The pairs of a class that are most alike, with how usual that is in it."""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

from grader.marking.extras.likeness.student_texts import StudentText
from grader.marking.extras.likeness.syntax_grams import Grams, overlap

FEWEST = 50  # sequences: below that, a comparison means nothing
USUAL_SHARE = 0.5  # of a class: what so many have in common comes from the task, its hints and the lesson
SMALL_CLASS = 8  # students: with fewer there is no way to know what is usual


@dataclass(frozen=True)
class LikePair:
    """Two students. likeness: from 0 to 1. as_like: how many pairs of the class are at least as alike."""

    first: StudentText
    second: StudentText
    likeness: float
    as_like: int = 0


@dataclass(frozen=True)
class ClassLikeness:
    """The pairs that are most alike, the first one most; of how many pairs; whose texts are too short.

    median: the likeness that half of all pairs exceed.
    """

    pairs: list[LikePair]
    total: int
    median: float
    short: list[str]


def most_alike(texts: Sequence[StudentText], count: int, current: set[str] | None = None) -> ClassLikeness:
    """Compare all pairs of a class.

    current: the students of this year, if texts of earlier years are among them: a pair has one of these.
    """
    usual = usual_grams(texts)
    own = {text.student: text.grams - usual for text in texts}
    long = [text for text in texts if len(own[text.student]) >= FEWEST]
    short = [text.student for text in texts if len(own[text.student]) < FEWEST]
    found = [
        (overlap(own[first.student], own[second.student]), first, second)
        for first, second in combinations(long, 2)
        if current is None or first.student in current or second.student in current
    ]
    values = sorted(likeness for likeness, _, _ in found)
    found.sort(key=lambda each: (-each[0], each[1].student, each[2].student))
    pairs = [
        LikePair(first, second, likeness, len(values) - bisect_left(values, likeness))
        for likeness, first, second in found[:count]
    ]
    return ClassLikeness(pairs, len(values), values[len(values) // 2] if values else 0.0, short)


def usual_grams(texts: Sequence[StudentText]) -> Grams:
    """The sequences that half of the class has, and more."""
    if len(texts) < SMALL_CLASS:
        return frozenset()
    counts = Counter(gram for text in texts for gram in text.grams)
    return frozenset(gram for gram, count in counts.items() if count >= USUAL_SHARE * len(texts))
