"""Seeds in which good robots do their work: python -m tests.exercises.fair 13b_delivery deliver --first 10

A warehouse drawn by chance may lie so that no one can do what a scenario asks for. For each seed the
solution's notebook and all right nodes are run in the scenarios of an exercise, in several orders of what
happens at the same time; where none of them misses anything it is fair.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Sequence
from typing import Any

from grader import Exercise
from grader.checks.verdicts import judge
from grader.programs import LocalPrograms
from grader.scenario import Scenario
from tests.exercises.seeds import SOLUTION, exercise_of, programs_named, right_nodes


def is_fair(
    exercise: Exercise, scenario: Scenario, programs: tuple[Any, ...], seed: int, orders: int
) -> bool:
    """Whether these programs miss nothing in a scenario with this seed, in the usual order and in others."""
    for order in range(orders):
        recording = scenario.run(source=LocalPrograms(programs), seed=seed, order=str(order or ""))
        verdicts = judge(exercise.checks, recording, scenario.name)
        if any(verdict.status != "passed" for verdict in verdicts):
            return False
    return True


def fair(
    folder: str, name: str, kinds: Sequence[str], numbers: range, orders: int
) -> Iterator[tuple[str, int, bool]]:
    """Each scenario's name with each seed, and whether no good robot misses anything."""
    topic = folder.split("_", 1)[1]
    exercise, names = exercise_of(topic, name), [SOLUTION, *right_nodes(topic, name)]
    robots = [programs_named(topic, name, node) for node in names]
    for scenario in exercise.scenarios:
        for seed in numbers if scenario.name in kinds or not kinds else ():
            found = (is_fair(exercise, scenario, robot, seed, orders) for robot in robots)
            yield scenario.name, seed, all(found)


def main(words: list[str]) -> None:
    """Print the seeds of each scenario as they are tried: the unfair ones with a minus."""
    parser = argparse.ArgumentParser(prog="python -m tests.exercises.fair", description=__doc__)
    parser.add_argument("folder", help="an assignment's folder in solutions/, such as 13b_delivery")
    parser.add_argument("exercise", help="the name of one with scenarios")
    parser.add_argument("scenarios", nargs="*", help="their names; all of them where none is given")
    parser.add_argument("--count", type=int, default=20, help="how many seeds")
    parser.add_argument("--first", type=int, default=10, help="the first one")
    parser.add_argument("--orders", type=int, default=5, help="how many orders, with the usual one")
    given = parser.parse_args(words)
    numbers = range(given.first, given.first + given.count)
    for name, seed, is_good in fair(given.folder, given.exercise, given.scenarios, numbers, given.orders):
        print(name, seed if is_good else -seed, flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
