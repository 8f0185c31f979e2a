"""How often the navigator of solutions/06b_navigating gets to its goal in worlds drawn from seeds.

python -m tests.bench.navigator --worlds 200
"""

import argparse
import math
import re
import statistics
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import NamedTuple

import nbformat

from grader.checks import traveled
from grader.exercises import navigator
from grader.geometry.ground import shortest
from sim import run
from sim.evidence import Recording
from sim.world import World
from tests.bench.report import table

NOTEBOOK = Path(__file__).parents[2] / "solutions" / "06b_navigating" / "navigating.ipynb"
KINDS = ("room", "clutter", "maze", "noisy", "blocked")
NEAR, SECONDS = 0.25, 120  # m, s
RUNS = re.compile(r"\brecording\b|\.grade\(")  # cells that run something


def solution() -> Callable[[], None]:
    """The main() that the notebook's own code defines."""
    module = ModuleType("navigator_solution")
    sys.modules[module.__name__] = module
    for cell in nbformat.read(NOTEBOOK, as_version=4).cells:
        if cell.cell_type == "code" and not RUNS.search(cell.source):
            exec(compile(cell.source, f"{NOTEBOOK.name}: {cell.id}", "exec"), vars(module))
    return module.main


def worlds(kind: str, seed: int) -> tuple[World, World]:
    """The world, and what its map knows of it."""
    return navigator.blocked(seed) if kind == "blocked" else (navigator.world_of(kind, seed),) * 2


class Outcome(NamedTuple):
    """How a drive went. fault: why the robot has not got there; "" if it has, and touched nothing."""

    seed: int
    fault: str
    detour: float  # its way by the shortest way
    speed: float  # m/s


def drive(main: Callable[[], None], kind: str, seed: int) -> Outcome:
    """Send the robot to the goal of a world."""
    real, known = worlds(kind, seed)
    client = navigator.made_for(navigator.GoalClient, goal=real.goal)
    recording = run(
        *navigator.bringup(real, known),
        client,
        main,
        world=real,
        seconds=SECONDS,
        seed=seed,
        until=lambda recording: bool(recording.goals) and recording.goals[0].over,
        quiet=True,
    )
    way = traveled(recording)
    return Outcome(seed, fault(recording), way / shortest(real), way / recording.stamp)


def fault(recording: Recording, near: float = NEAR) -> str:
    """Why the robot has not got to its goal; "" if it has, and touched nothing."""
    end, goal = recording.path[-1], recording.world.goal
    if recording.contacts:
        return f"a {recording.contacts[0].what} touched at {recording.contacts[0].stamp:.1f} s"
    if not recording.goals or recording.goals[0].status != "succeeded":
        return f"the goal is {recording.goals[0].status if recording.goals else 'not taken'}"
    left = math.dist(goal, (end.x, end.y))
    return f"{left:.2f} m away" if left > near else ""


def main() -> int:
    """Drive in all of them; the exit status says whether fewer than 95 % succeeded."""
    parser = argparse.ArgumentParser("python -m tests.bench.navigator", description=__doc__.splitlines()[0])
    parser.add_argument("--worlds", type=int, default=200, help="how many; default 200")
    count = parser.parse_args().worlds
    program, rows, reached = solution(), [], 0
    for index, kind in enumerate(KINDS):
        seeds = range(1000, 1000 + (count + len(KINDS) - 1 - index) // len(KINDS))
        outcomes = [drive(program, kind, seed) for seed in seeds]
        good = [outcome for outcome in outcomes if not outcome.fault]
        for outcome in outcomes:
            if outcome.fault:
                print(f"{kind} {outcome.seed}: {outcome.fault}")
        reached += len(good)
        means = [_mean([outcome.detour for outcome in good]), _mean([outcome.speed for outcome in good])]
        rows.append([kind, len(outcomes), len(good), *means])
    table(["", "worlds", "reached", "way / shortest", "m/s"], rows)
    print(f"the goal reached, nothing touched: {reached} of {count} worlds, {reached / count:.1%}")
    return int(reached < 0.95 * count)


def _mean(values: list[float]) -> str:
    return f"{statistics.fmean(values):.2f}" if values else "-"


if __name__ == "__main__":
    sys.exit(main())
