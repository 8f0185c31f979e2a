"""What a judge is told to do, on its way from the marker's process to the judge's."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from grader.marking.plan import Task

RESULT = 250_000_000  # bytes of a result on its way back: JSON, where a letter may take six
ANSWER_S = 60.0  # for an answer of either, on a busy machine
FOLDERS = ("folder", "release")


@dataclass(frozen=True)
class Patience:
    """Seconds of wall time that things may take, however busy the machine is.

    start: until a student's process answers. cell: one cell. test: what a test cell runs. notebook: all of
    its cells.
    """

    start: float = 60.0
    cell: float = 60.0
    test: float = 120.0
    notebook: float = 600.0


def given(task: Task, secret: str, patience: Patience) -> dict[str, Any]:
    """An order as plain data."""
    folders = {name: str(getattr(task, name).absolute()) for name in FOLDERS}
    return {"task": vars(task) | folders, "secret": secret, "patience": vars(patience)}


def taken(order: Mapping[str, Any]) -> tuple[Task, str, Patience]:
    """What `given` made data of."""
    folders = {name: Path(order["task"][name]) for name in FOLDERS}
    return Task(**order["task"] | folders), order["secret"], Patience(**order["patience"])
