"""The course's moving pictures: the benchmarks' scenario for the README, and a navigator for lesson 6.

python -m tests.bench.picture
"""

from pathlib import Path

from grader.exercises import navigator
from sim import run
from sim.evidence import Recording
from sim.view import animate
from tests.bench.navigator import solution
from tests.bench.report import avoider_run

IMAGES = Path("course/images")


def navigator_run() -> Recording:
    """A room with a box in the way that is in no map."""
    room, known = navigator.blocked(seed=5)
    client = navigator.made_for(navigator.GoalClient, goal=room.goal)
    return run(*navigator.bringup(room, known), client, solution(), world=room, seconds=22, quiet=True)


if __name__ == "__main__":
    for name, recording, speed in (
        ("run.png", avoider_run(world="room", seconds=60), 3),
        ("navigator.png", navigator_run(), 4),
    ):
        picture = IMAGES / name
        picture.write_bytes(bytes(animate(recording, speed=speed)))
        print(f"{picture}: {picture.stat().st_size / 1000:.0f} kB")
