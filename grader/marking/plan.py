"""A submission to mark, as data that crosses processes. What makes the tasks is intake.py."""
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Task:
    """One submission to mark: plain data that crosses processes.

    folder: the submission's notebooks as they were handed in. release: the instructor's, without answers.
    key: hexadecimal digest of everything that is marked; the Result carries the same.
    """

    student: str
    assignment: str
    folder: Path
    release: Path
    key: str
