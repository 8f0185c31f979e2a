"""The warehouse of the lesson, and what the whole robot does in it."""

from whole import Control, Decision, Perception

from grader.checks import shift
from grader.exercises.delivery.deliver import questions
from sim import Recording, World, run

__all__ = ["SEED", "WAREHOUSE", "goal", "questions", "shift"]

SEED = 2
WAREHOUSE = World.generate("warehouse", seed=SEED)


def goal() -> Recording:
    """A delivery robot's minute."""
    return run(Perception, Decision, Control, world=WAREHOUSE, seconds=60, seed=SEED, quiet=True)
