"""Marks the class in the current folder, killed at random moments, until a run comes to its end.

    python -m tests.marking.office.killed SEED

Prints how many runs were killed. A program of its own: it forks, once everything is imported.
"""
import os
import random
import select
import signal
import sys
from pathlib import Path

from grader.marking.office.course import Course
from grader.marking.office.mark import Settings, mark
from tests.marking.classroom import ASSIGNMENT
from tests.marking.office.marking import opening

KILLS = 25
LONGEST = 0.6  # seconds until the kill; about as long as a whole run takes


def run() -> None:
    """Mark the class in a child that ends without cleaning up."""
    course = Course(Path.cwd())
    mark(course, ASSIGNMENT, Settings(), opening(course))


def main(seed: int) -> None:
    chance = random.Random(seed)
    killed = 0
    while True:
        begun, begin = os.pipe()
        child = os.fork()
        if child == 0:
            os.write(begin, b"!")
            run()
            os._exit(0)
        os.read(begun, 1)
        os.close(begin)  # now its end of the pipe closes with the child
        left = None if killed >= KILLS else chance.uniform(0, LONGEST)
        if select.select([begun], [], [], left)[0] == []:
            os.kill(child, signal.SIGKILL)
        os.close(begun)
        _, status = os.waitpid(child, 0)
        if not os.WIFSIGNALED(status):
            print(killed)
            sys.exit(os.waitstatus_to_exitcode(status))
        killed += 1


if __name__ == "__main__":
    main(int(sys.argv[1]))
