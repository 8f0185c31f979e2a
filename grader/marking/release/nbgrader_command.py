"""Runs nbgrader's own commands in a course folder."""
import os
import subprocess
import sys
from pathlib import Path

from grader.marking.errors import CommandFailed

ERROR_LINES = 12


def nbgrader(course: Path, *arguments: str, **variables: str) -> None:
    """Run `nbgrader ARGUMENTS` in the folder `course`, beside its configuration. Raises CommandFailed.

    variables: more of the environment.
    """
    command = [sys.executable, "-m", "nbgrader", *arguments]
    env, pipe, same = {**os.environ, **variables}, subprocess.PIPE, subprocess.STDOUT
    done = subprocess.run(command, cwd=course, text=True, env=env, stdout=pipe, stderr=same)
    if done.returncode:
        raise failure(course, " ".join(arguments), done.stdout)


def failure(course: Path, command: str, output: str) -> CommandFailed:
    """The error for a command of nbgrader, with the end of its output."""
    last = "\n    ".join(output.strip().splitlines()[-ERROR_LINES:])
    return CommandFailed(f"`nbgrader {command}` failed in {course}:\n    {last}")


def assignments(course: Path) -> list[str]:
    """Return the names of the assignments in `course`: the folders of solutions/ that hold a notebook."""
    return sorted({notebook.parent.name for notebook in course.glob("solutions/*/*.ipynb")})
