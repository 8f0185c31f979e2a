"""Marks one submission: leads the student's processes through the notebooks, and judges what they hand over.

This is the side that is trusted: simulator, companions, worlds from the secret and all judging are here.
"""

from __future__ import annotations

import math
import os
import traceback
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from time import monotonic
from typing import Any

from nbformat import NotebookNode

from grader.exercise import SECRET, Exercise
from grader.marking.court import verdicts
from grader.marking.court.outputs import Outputs, Screen, plain
from grader.marking.court.pupil import Gone, Pupil
from grader.marking.court.testcells import graded, is_test
from grader.marking.court.testcells import load as load_exercise
from grader.marking.mending.rebuild import Mended, mend
from grader.marking.mending.submission import Release, load
from grader.marking.mending.words import Unusable, quoted
from grader.marking.plan import Task
from grader.marking.result import CellResult, NotebookResult, Result
from grader.marking.suspicion import suspicions

THREADS = "A thread of the notebook {} still ran when its last cell was over."
MOST_TRICKS = 20  # of a notebook are told
DATA = 20_000_000  # bytes of the files that a release may bring along

Pupils = Callable[[], Pupil]  # gives a fresh process, for one notebook


@dataclass
class Marking:
    """One submission while it is marked."""

    task: Task
    release: Release
    mended: Mended
    screen: Screen = field(default_factory=Screen)
    flags: list[str] = field(default_factory=list)
    stops: list[str] = field(default_factory=list)  # why a notebook did not come to its end
    timings: dict[str, float] = field(default_factory=lambda: {"judged": 0.0})


def mark(task: Task, secret: str, pupils: Pupils) -> Result:
    """Mark a submission with worlds and seeds from the secret, or with the public ones where it is "".

    Raises nothing for anything that a student may have done; NotOurs for a release that can't be marked here.
    """
    began = monotonic()
    os.environ[SECRET] = secret
    release = load(task.release)
    try:
        mended = mend(task.folder, release)
    except Unusable as reason:
        return Result(task.student, task.assignment, task.key, "refused", str(reason))
    marking = Marking(task, release, mended, flags=list(mended.flags))
    files = _files(task.release, release.data)
    notebooks = [_notebook(marking, name, files, pupils) for name in release.notebooks]
    marking.timings["total"] = monotonic() - began
    repaired = "repaired" if mended.repairs else "marked"
    return Result(
        task.student,
        task.assignment,
        task.key,
        "stopped" if marking.stops else repaired,
        " ".join(marking.stops),
        mended.repairs,
        marking.flags,
        notebooks,
        marking.timings,
    )


def as_text(result: Result) -> str:
    """A result as JSON that every program can read, whatever characters the student used."""
    return plain(result.to_json())


def _notebook(marking: Marking, name: str, files: Mapping[str, bytes], pupils: Pupils) -> NotebookResult:
    """Run a notebook to its end, or as far as it goes; the tests behind that give no points."""
    exercises = {cell: load_exercise(full) for cell, full in graded(marking.release.notebooks[name]).items()}
    rebuilt = marking.mended.notebooks.get(name)
    notebook = marking.release.notebooks[name] if rebuilt is None else rebuilt.notebook
    results: list[CellResult] = []
    if rebuilt is None:
        marking.stops.append(marking.mended.missing[name])
    else:
        marking.flags += _tricks(notebook, marking.release.notebooks[name])
        _Desk(marking, name, exercises, results).work(notebook, files, pupils)
    done = {result.cell for result in results}
    missed = [cell for cell in notebook.cells if is_test(cell) and _name(cell) not in done]
    results += [_nothing(cell, exercises[_name(cell)]) for cell in missed]
    return NotebookResult(name, notebook, results)


class _Desk:
    """Where one notebook is run. results: grows by one for each test cell."""

    def __init__(
        self, marking: Marking, name: str, exercises: Mapping[str, Exercise], results: list[CellResult]
    ) -> None:
        self._marking, self._name = marking, name
        self._exercises, self._results = exercises, results
        # Cells of ours that only show a run: the student has seen that, and the test looks at it anew.
        cells = marking.release.notebooks[name].cells
        self._looks = {cell.source for cell in cells if cell.cell_type == "code" and not _name(cell)}

    def work(self, notebook: NotebookNode, files: Mapping[str, bytes], pupils: Pupils) -> None:
        """Run all code cells in order, as far as the process lives."""
        began, number = monotonic(), 0
        where = "before its first cell"
        pupil = pupils()
        try:
            pupil.begin(files)
            self._marking.timings["start"] = monotonic() - began
            for cell in (cell for cell in notebook.cells if cell.cell_type == "code"):
                number += bool(cell.source.strip())  # as Jupyter counts
                where = f"in {_called(cell, number)}"
                self._run(pupil, cell, number)
            if pupil.threads:
                self._marking.flags.append(THREADS.format(quoted(self._name)))
        except Gone as gone:
            self._marking.stops.append(f"The notebook {quoted(self._name)} stopped {where}. {gone}")
        finally:
            pupil.hang_up()

    def _run(self, pupil: Pupil, cell: NotebookNode, number: int) -> None:
        outputs, began = Outputs(self._marking.screen), monotonic()
        try:
            if is_test(cell):
                cell.outputs = self._test(pupil, cell, number, outputs)
            else:
                pupil.run(cell.source, outputs, pictures=cell.source not in self._looks)
                cell.outputs = outputs.list
        except Gone as gone:
            outputs.say(f"The notebook stopped here. {gone} The cells below were not run.")
            cell.outputs = outputs.list
            raise
        finally:
            cell.execution_count = number or None
            for output in cell.outputs:
                if output["output_type"] == "execute_result":
                    output["execution_count"] = number
            self._marking.timings[f"{self._name}/{cell.id}"] = monotonic() - began

    def _test(self, pupil: Pupil, cell: NotebookNode, number: int, shown: Outputs) -> list[dict[str, Any]]:
        """Judge what a test cell hands over; returns the cell's outputs, which are the judge's own."""
        grade_id = _name(cell)
        exercise = self._exercises[grade_id]
        tested = pupil.test(cell.source, exercise, shown)
        self._flag(cell, tested.flags)
        if tested.error is not None:
            return self._broke(cell, tested.error)
        if tested.score is None:
            self._results.append(_nothing(cell, exercise))
            shown.say("No points: this cell ended before the nodes could be run.")
            return shown.list
        score, worth = tested.score, float(cell.metadata.nbgrader.points)
        self._marking.timings["judged"] += math.fsum(recording.stamp for recording in score.recordings)
        problems = verdicts.alarms(score)
        if score.max != worth:
            problems.append(f"worth {worth:g} points in the notebook and {score.max:g} in its exercise")
        self._flag(cell, problems)
        fair = verdicts.without_gifts(score)
        self._results.append(verdicts.cell_result(grade_id, fair, worth, bool(problems)))
        return [*verdicts.outputs(fair, number), *shown.printed]

    def _broke(self, cell: NotebookNode, error: Exception) -> list[dict[str, Any]]:
        """Our own mistake: the instructor has to look."""
        last = traceback.format_exception_only(error)[-1].strip()
        self._flag(cell, [f"could not be judged, by a mistake of the course: {last}"])
        self._results.append(replace(_nothing(cell, self._exercises[_name(cell)]), needs_look=True))
        words = "This cell could not be judged, by a mistake of the course. Your instructor will look at it."
        return [{"output_type": "stream", "name": "stdout", "text": words + "\n"}]

    def _flag(self, cell: NotebookNode, problems: Sequence[str]) -> None:
        name = f"The test cell {quoted(_name(cell))}"
        self._marking.flags += [f"{name}: {plain(problem)}." for problem in problems]


def _tricks(notebook: NotebookNode, release: NotebookNode) -> list[str]:
    """A sentence for each suspicious thing in it that the release doesn't do itself."""
    ours = set(suspicions(_sources(release)))
    tricks = [trick for trick in suspicions(_sources(notebook)) if trick not in ours]
    if len(tricks) > MOST_TRICKS:
        tricks[MOST_TRICKS:] = [f"There are {len(tricks) - MOST_TRICKS} more such things in it."]
    return tricks


def _sources(notebook: NotebookNode) -> list[tuple[str, str]]:
    return [(_name(cell) or cell.id, cell.source) for cell in notebook.cells if cell.cell_type == "code"]


def _nothing(cell: NotebookNode, exercise: Exercise) -> CellResult:
    return CellResult(_name(cell), exercise.name, 0.0, float(cell.metadata.nbgrader.points))


def _name(cell: NotebookNode) -> str:
    return cell.metadata.get("nbgrader", {}).get("grade_id", "")


def _called(cell: NotebookNode, number: int) -> str:
    name = _name(cell)
    return f"its cell {quoted(name)}" if name else f"its code cell {number}"


def _files(folder: Path, names: Iterable[str]) -> dict[str, bytes]:
    """The files that the release brings along, by name. Raises ValueError if they are too large."""
    files = {name: (folder / name).read_bytes() for name in sorted(names)}
    size = sum(map(len, files.values()))
    if size > DATA:
        raise ValueError(f"the files in {folder} have {size / 1e6:.0f} MB; expected {DATA / 1e6:g} at most")
    return files
