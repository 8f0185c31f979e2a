"""A submission to mark and how, as data that crosses processes and machines; intake.py makes the tasks."""

from __future__ import annotations

import os
import pickle
import socket
import tempfile
from dataclasses import dataclass, field

from grader.marking.league.contest import Contest
from grader.marking.submission.assignment_release import Release
from grader.marking.submission.submitted_files import SubmittedFiles

RESULT = 250_000_000  # bytes of a result on its way back: JSON, where a letter may take six


@dataclass(frozen=True)
class TimeLimits:
    """Seconds of wall time that things may take, however busy the machine is.

    start: until a student's process answers. cell: one cell. test: what a test cell runs. notebook: all of
    its cells.
    """

    start: float = 60.0
    cell: float = 60.0
    test: float = 300.0  # the delivery robot takes one minute, on a machine with nothing else to do
    notebook: float = 600.0


@dataclass(frozen=True)
class Task:
    """One submission to mark: all that was read of it, so nobody has to read it again.

    release: the instructor's, without answers. key: hexadecimal digest of everything that is marked; the
    Result carries the same. contest: plays in it, instead of being marked.
    """

    student: str
    release: Release
    submitted: SubmittedFiles
    key: str
    contest: Contest | None = None

    @property
    def assignment(self) -> str:
        """Its name."""
        return self.release.assignment


@dataclass(frozen=True)
class JudgeOrder:
    """What a judge is told. secret: where private worlds and seeds come from; "" for the public ones."""

    task: Task
    secret: str = field(repr=False)
    time_limits: TimeLimits


def send_order(sock: socket.socket, order: JudgeOrder) -> None:
    """Hand an order to the judge at the other end, through a file: it may be large. Raises OSError."""
    with tempfile.TemporaryFile() as file:
        pickle.dump(order, file)
        file.seek(0)
        socket.send_fds(sock, [b"."], [file.fileno()])


def receive_order(sock: socket.socket) -> JudgeOrder:
    """Take what `send_order` hands over; only from who is believed. Raises OSError where nobody is there."""
    _, descriptors, _, _ = socket.recv_fds(sock, 1, 1)
    if not descriptors:
        raise ConnectionResetError("nobody sent an order")
    with os.fdopen(descriptors[0], "rb") as file:
        return pickle.load(file)
