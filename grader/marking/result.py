"""The result of marking one submission: plain data that crosses processes as JSON and is then checked."""

from __future__ import annotations

import json
import math
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from grader.marking.errors import ResultError

MAX_BYTES = 60_000_000  # of one submission's result

# marked: as usual. repaired: the notebook was repaired first. stopped: the student's code was stopped, or
# ended its process, before the last cell. refused: nothing could be run. broken: nothing could be judged,
# because the course or this machine failed; such a result is never entered.
VERDICTS = ("marked", "repaired", "stopped", "refused", "broken")
VERDICT_FIELDS = ("name", "sentence", "status", "expected", "saw", "hint", "alarm")  # texts


@dataclass(frozen=True)
class CellResult:
    """The result of one test cell, as the instructor's process judged it."""

    cell: str  # nbgrader's grade_id
    exercise: str
    points: float
    max: float
    verdicts: list[dict[str, Any]] = field(default_factory=list)  # as in Score.as_dict()
    digests: list[str] = field(default_factory=list)  # of the recordings that were judged
    needs_look: bool = False  # a check of the course raised an error: the instructor decides
    games: list[dict[str, Any]] = field(default_factory=list)  # as in Game.as_dict(), in a league alone


@dataclass(frozen=True)
class NotebookResult:
    """One notebook after marking: nbformat 4 JSON with outputs, and its test cells in order."""

    name: str  # without .ipynb
    notebook: dict[str, Any]
    cells: list[CellResult] = field(default_factory=list)


@dataclass(frozen=True)
class Result:
    """The result of marking one submission.

    key: hexadecimal digest of everything that was marked: submission, release, secret, version.
    repairs: a sentence for each repair. flags: one for each thing that no honest submission does.
    reason: why it was stopped, refused or broken; "" otherwise.
    timings: seconds by name ("total", "start", and each cell as "notebook/cell"; "judged" are simulated
        ones, of the runs that were judged); peak memory in MB as "memory". They are no part of the grade.
    """

    student: str
    assignment: str
    key: str
    verdict: str
    reason: str = ""
    repairs: list[str] = field(default_factory=list)
    flags: list[str] = field(default_factory=list)
    notebooks: list[NotebookResult] = field(default_factory=list)
    timings: dict[str, float] = field(default_factory=dict)

    @property
    def points(self) -> float:
        """The points of the submission."""
        return math.fsum(cell.points for notebook in self.notebooks for cell in notebook.cells)

    @property
    def judged(self) -> bool:
        """Return whether at least one test cell was judged."""
        return any(cell.verdicts for notebook in self.notebooks for cell in notebook.cells)

    @property
    def why_not_judged(self) -> str:
        """The first reason, flag or error of its notebooks."""
        cells = [cell for note in self.notebooks for cell in note.notebook.get("cells", ())]
        outputs = [output for cell in cells for output in cell.get("outputs", ())]
        errors = [f"{one['ename']}: {one['evalue']}" for one in outputs if one["output_type"] == "error"]
        return next(filter(None, (self.reason, *self.flags, *errors)), "its test cells ran no nodes")

    def to_json(self) -> str:
        """Return it as text. The same result gives the same text."""
        data = asdict(self)
        for cell in (cell for notebook in data["notebooks"] for cell in notebook["cells"]):
            if not cell["games"]:  # only a league has games: without them, digests of results stay the same
                del cell["games"]
        return json.dumps(data, sort_keys=True, ensure_ascii=False, allow_nan=False)

    def grade_json(self) -> str:
        """The same without the timings, which differ from one marking to the next."""
        return replace(self, timings={}).to_json()

    @staticmethod
    def from_json(text: str | bytes) -> Result:
        """Read what `to_json` wrote. Raises ResultError with one sentence for anything else."""
        if len(text) > MAX_BYTES:
            size = len(text) / 1e6
            raise ResultError(f"a result has at most {MAX_BYTES / 1e6:g} MB, this one has {size:.0f} MB")
        try:
            data = json.loads(text, parse_constant=_refuse)
            notebooks = [
                NotebookResult(**{**item, "cells": [CellResult(**cell) for cell in item["cells"]]})
                for item in data.pop("notebooks")
            ]
            result = Result(**data, notebooks=notebooks)
            _check(result)
        except (TypeError, KeyError, AttributeError, ValueError, RecursionError) as error:
            raise ResultError(f"this is not a result of marking: {error}") from None
        return result


def _refuse(constant: str) -> float:
    raise ValueError(f"{constant} is not a number")


def _check(result: Result) -> None:
    """Raise ValueError for values that the types above don't allow."""
    for name in (result.student, result.assignment, *(notebook.name for notebook in result.notebooks)):
        if not isinstance(name, str) or name in ("", ".", "..") or set(name) & set("/\0"):
            raise ValueError(f"{name!r} can't be the name of a folder or file")
    if result.verdict not in VERDICTS:
        raise ValueError(f"the verdict is one of {', '.join(VERDICTS)}, not {result.verdict!r}")
    if not (isinstance(result.repairs, list) and isinstance(result.flags, list)):
        raise ValueError("repairs and flags are lists")
    _check_text("key, reason, repairs and flags", result.key, result.reason, *result.repairs, *result.flags)
    _check_numbers("the timings", *result.timings.values())
    for notebook in result.notebooks:
        cells = notebook.notebook["cells"]
        if not isinstance(cells, list) or not all(isinstance(cell, dict) for cell in cells):
            raise ValueError(f"{notebook.name} holds no cells")
        names = [cell.cell for cell in notebook.cells]
        if len(set(names)) < len(names):
            raise ValueError(f"a test cell of {notebook.name} has two results")
        for cell in notebook.cells:
            _check_cell(cell)


def _check_cell(cell: CellResult) -> None:
    _check_text("a cell's name, its exercise and the digests", cell.cell, cell.exercise, *cell.digests)
    _check_numbers(f"the points of {cell.cell}", cell.points, cell.max)
    if not 0 <= cell.points <= cell.max:
        raise ValueError(f"{cell.cell} has {cell.points:g} points of {cell.max:g}")
    if not isinstance(cell.needs_look, bool):
        raise ValueError(f"{cell.cell} needs a look or doesn't")
    for verdict in cell.verdicts:
        _check_text(f"the verdicts of {cell.cell}", *(verdict[key] for key in VERDICT_FIELDS))


def _check_text(what: str, *words: object) -> None:
    if not all(isinstance(word, str) for word in words):
        raise ValueError(f"{what} are text")


def _check_numbers(what: str, *numbers: Any) -> None:
    if not all(type(number) in (int, float) and math.isfinite(number) for number in numbers):
        raise ValueError(f"{what} are finite numbers")
