"""Right nodes in many orders: python -m tests.exercises.orders 08_joints [EXERCISE ...]"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Sequence

from grader.programs import LocalPrograms
from tests.exercises.builds import kept_builds
from tests.exercises.score_tables import graded_exercises, shown
from tests.exercises.seeds import SOLUTION, exercise_of, programs_named, right_nodes


def fallen_short_in_orders(
    topic: str, name: str, numbers: Sequence[int], level: str = "", *, every: bool = False
) -> Iterator[str]:
    """What the solution and the right nodes miss in these orders.

    They take turns, unless every one is tried in each order.
    """
    exercise, names = exercise_of(topic, name), [*right_nodes(topic, name), SOLUTION]
    right = {node: programs_named(topic, name, node) for node in names}
    for number in numbers:
        for node in names if every else [names[number % len(names)]]:
            order = f"{level}{number}"
            score = exercise.judge(LocalPrograms(right[node]), order=order)
            if shown(node, score) != f"{node}: {exercise.points:g}":
                yield f"order {order}: {shown(node, score)}"


def main(words: list[str]) -> int:
    """Judge all or some exercises of an assignment; the exit status says whether any node fell short."""
    parser = argparse.ArgumentParser(prog="python -m tests.exercises.orders", description=__doc__)
    parser.add_argument("folder", help="an assignment's folder in solutions/, such as 08_joints")
    parser.add_argument("exercises", nargs="*", help="their names; all of them where none is given")
    parser.add_argument("--count", type=int, default=50, help="how many orders each")
    parser.add_argument("--first", type=int, default=1, help="the first one's number")
    parser.add_argument("--level", default="", help="such as host- or any-")
    parser.add_argument("--every", action="store_true", help="each right node in each order")
    given = parser.parse_args(words)
    topic = given.folder.split("_", 1)[1]
    failed = False
    with kept_builds():
        for name in given.exercises or graded_exercises(given.folder):
            numbers = range(given.first, given.first + given.count)
            short = list(fallen_short_in_orders(topic, name, numbers, given.level, every=given.every))
            print(
                f"{topic}/{name}: {len(short)} fall short in {given.count} orders",
                *short,
                sep="\n",
                flush=True,
            )
            failed |= bool(short)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
