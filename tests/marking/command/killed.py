"""Marks copies of the class in this folder, killed at random moments, each until a run comes to its end.

    python -m tests.marking.command.killed SEED

The copies lie beside that folder: ended1, ended2 and so on. Prints how many runs were killed and how many
copies were marked. A moment is a number of calls from Python into C, as every write to a file or a database
is one: the same moments on any machine. A program of its own: it forks, once everything is imported.
"""
import os
import random
import shutil
import signal
import sys
from pathlib import Path
from types import FrameType

from grader.marking.command.mark_class import Settings, mark_class
from grader.marking.gradebook.course import Course
from tests.marking.classroom import ASSIGNMENT
from tests.marking.fake_pool import opening

KILLS = 20


class Killer:
    """Counts the calls into C, and kills this process at the given one."""

    def __init__(self, moment: float) -> None:
        self.moment, self.calls = moment, 0

    def __call__(self, frame: FrameType, event: str, argument: object) -> None:
        if event == "c_call":
            self.calls += 1
            if self.calls >= self.moment:
                os.kill(os.getpid(), signal.SIGKILL)


def run(root: Path, moment: float) -> int:
    """Mark the class in a child that ends without cleaning up. Its calls, or 0 if it was killed."""
    count, reported = os.pipe()
    child = os.fork()
    if child == 0:
        killer = Killer(moment)
        sys.setprofile(killer)
        mark_class(Course(root), ASSIGNMENT, Settings(), opening(Course(root)))
        sys.setprofile(None)
        os.write(reported, str(killer.calls).encode())
        os._exit(0)
    os.close(reported)
    _, status = os.waitpid(child, 0)
    with os.fdopen(count) as counted:
        return 0 if os.WIFSIGNALED(status) else int(counted.read())


def main(seed: int) -> None:
    chance = random.Random(seed)
    fresh = Path.cwd()
    whole = run(shutil.copytree(fresh, fresh.with_name("uninterrupted")), float("inf"))
    killed = ended = 0
    while killed < KILLS:
        ended += 1
        root = shutil.copytree(fresh, fresh.with_name(f"ended{ended}"))
        while run(root, chance.uniform(0, whole)) == 0:
            killed += 1
    print(killed, ended)


if __name__ == "__main__":
    main(int(sys.argv[1]))
