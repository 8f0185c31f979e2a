"""A submission to mark and the order for a judge: data that crosses processes and machines."""

from __future__ import annotations

import os
import pickle
import socket
import tempfile
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any, Protocol

from grader.marking.result import Result
from grader.marking.submission.assignment_release import Release
from grader.marking.submission.submitted_files import SubmittedFiles

MAX_RESULT_BYTES = 250_000_000  # JSON, in which a character may take six bytes


@dataclass(frozen=True)
class TimeLimits:
    """Limits of wall time in seconds, which hold however busy the machine is.

    start: until a student's process is ready. cell: for one cell. test: for the runs of a test cell.
    notebook: for all its cells.
    """

    start: float = 120.0  # 1 s on a machine that is not busy
    cell: float = 60.0
    test: float = 300.0  # the delivery robot takes one minute on an idle machine
    notebook: float = 600.0


class Procedure(Protocol):
    """A judge's procedure for a submission in place of marking it; it crosses processes with the task."""

    def run(self, marking: Any) -> None:
        """Take all steps. marking: the `MarkingState` of the task, which gets the results."""


@dataclass(frozen=True)
class MarkingTask:
    """One submission to mark, with the contents of all its files.

    release: the instructor's, without answers. key: hexadecimal digest of everything that is marked; the
    Result has the same. procedure: None to mark it. only: the names of the test cells that are judged, if not
    all of them.
    """

    student: str
    release: Release
    submitted: SubmittedFiles
    key: str
    procedure: Procedure | None = None
    only: frozenset[str] = frozenset()

    @property
    def assignment(self) -> str:
        """Its name."""
        return self.release.assignment

    def judges(self, test_cell: str) -> bool:
        """Return whether the test cell with this grade_id is judged."""
        return not self.only or test_cell in self.only


class TaskPool(Protocol):
    """Carries out tasks in processes of their own, such as `Pool`."""

    def mark(self, tasks: Iterable[MarkingTask]) -> Iterator[Result]:
        """Yield the results as they are ready."""


@dataclass(frozen=True)
class JudgeOrder:
    """An order for a judge. secret: private worlds and seeds are derived from it; "" for the public ones."""

    task: MarkingTask
    secret: str = field(repr=False)
    time_limits: TimeLimits


def send_order(sock: socket.socket, order: JudgeOrder) -> None:
    """Send an order to the judge at the other end, in a file, because it may be large. Raises OSError."""
    with tempfile.TemporaryFile() as file:
        pickle.dump(order, file)
        file.seek(0)
        socket.send_fds(sock, [b"."], [file.fileno()])


def receive_order(sock: socket.socket) -> JudgeOrder:
    """Receive what `send_order` sends, from a trusted process. Raises OSError if the other end is closed."""
    _, descriptors, _, _ = socket.recv_fds(sock, 1, 1)
    if not descriptors:
        raise ConnectionResetError("no order was sent")
    with os.fdopen(descriptors[0], "rb") as file:
        order: JudgeOrder = pickle.load(file)
        return order
