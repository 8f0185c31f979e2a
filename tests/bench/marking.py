"""Marking a class: submissions a minute, beside nbgrader's own autograde; memory; from 10 to 200."""

import os
import shutil
import subprocess
import sys
import tempfile
import time
from itertools import cycle
from pathlib import Path

import nbformat
import psutil

from grader.marking.release.make_exercises import copy_of_course, release
from grader.marking.release.samples import SHARES, submission
from grader.marking.secret import ACCEPTED
from tests.bench.report import table

ASSIGNMENT = "02_topics"
COMPARED, GROWTH = 40, (10, 200)
AUTOGRADE = [sys.executable, "-m", "nbgrader", "autograde", ASSIGNMENT]
MARK = [sys.executable, "-m", "grader", "mark", ASSIGNMENT, "--no-feedback"]


def hand_in(course: Path, count: int) -> None:
    """Submissions of so many students in turn: all right, half right, not begun. Earlier ones go."""
    shutil.rmtree(course / "class" / "submitted", ignore_errors=True)
    starter = next((course / "exercises" / ASSIGNMENT).glob("*.ipynb"))
    right = nbformat.read(course / "solutions" / ASSIGNMENT / starter.name, 4)
    blank = nbformat.read(starter, 4)
    notebooks = [submission(right, blank, share) for share in SHARES.values()]
    for number, notebook in zip(range(count), cycle(notebooks), strict=False):
        folder = course / "class" / "submitted" / f"student_{number:03}" / ASSIGNMENT
        folder.mkdir(parents=True)
        nbformat.write(notebook, folder / starter.name)


def forget(course: Path) -> None:
    """Let nothing be marked yet."""
    for name in ("autograded", "feedback", "marking", "gradebook.db"):
        path = course / "class" / name
        shutil.rmtree(path, ignore_errors=True) if path.is_dir() else path.unlink(missing_ok=True)
    release(course)


def measured(course: Path, words: list[str]) -> tuple[float, float]:
    """Run a command in the course: wall time (s), and the most memory of all its processes together (MB)."""
    began, most = time.perf_counter(), 0
    with tempfile.TemporaryFile() as said:  # a pipe that no one reads would hold up who writes much
        process = psutil.Popen(words, cwd=course, stdout=subprocess.DEVNULL, stderr=said)
        while process.poll() is None:
            most = max(most, _memory(process))
            try:
                process.wait(1.0)  # to look takes 30 ms, which those that are measured lack
            except psutil.TimeoutExpired:
                continue
        seconds = time.perf_counter() - began
        if process.returncode:
            said.seek(0)
            raise RuntimeError(f"{' '.join(words)} failed:\n{said.read().decode()[-2000:]}")
    return seconds, most / 1e6


def _memory(process: psutil.Process) -> int:
    """Memory in bytes of a process and all its children, what they share counted once."""
    total = 0
    try:
        family = [process, *process.children(recursive=True)]
    except psutil.NoSuchProcess:
        return 0
    for member in family:
        try:
            total += member.memory_full_info().pss
        except (psutil.NoSuchProcess, psutil.AccessDenied):
            continue
    return total


def row(course: Path, title: str, words: list[str], count: int) -> tuple[float, list[object]]:
    """Mark so many submissions from nothing: wall time (s), and a line of the table."""
    forget(course)
    hand_in(course, count)
    seconds, memory = measured(course, words)
    return seconds, [title, count, f"{seconds:.1f}", f"{60 * count / seconds:.0f}", f"{memory:.0f}"]


def main() -> None:
    """Compare on the same notebooks, then let the class grow."""
    os.environ[ACCEPTED] = "yes"
    with tempfile.TemporaryDirectory() as folder:
        course = copy_of_course(Path.cwd(), Path(folder))
        stock, first = row(course, "nbgrader autograde", AUTOGRADE, COMPARED)
        own, second = row(course, "grader mark", MARK, COMPARED)
        rest = [row(course, "grader mark", MARK, count)[1] for count in GROWTH]
    table(["", "submissions", "s", "a minute", "memory, MB"], [first, second, *rest])
    print(f"{COMPARED} submissions: {stock / own:.1f} times as fast as nbgrader autograde")


if __name__ == "__main__":
    main()
