"""Runs one notebook cell by cell in a student's process, and judges the nodes of its test cells."""

from __future__ import annotations

import math
import traceback
from collections.abc import Sequence
from dataclasses import replace
from time import monotonic
from typing import Any

from nbformat import NotebookNode

from grader.marking.errors import StudentProcessGone
from grader.marking.judge import score_outputs
from grader.marking.judge.cell_outputs import CellOutputs, DisplayRegistry
from grader.marking.judge.display_only_cells import display_only_cells
from grader.marking.judge.marking_state import MarkingState, cell_name, no_points
from grader.marking.judge.other_variants import answered_variants
from grader.marking.judge.plain_tests import PlainTest, read_points
from grader.marking.judge.student_session import StudentSession
from grader.marking.judge.testcells import imported_packages, is_test
from grader.marking.outputs import writable_text
from grader.marking.submission.quoting import quote

EMPTY_CELL = "pass"  # in place of a cell that is skipped, so that the others keep their numbers
MAX_RESTARTS = 3
NOT_RUN_BELOW = "The cells below were not run."
RESTARTED = "It was started again after this cell, and the cells below were run."
USED_UP = "Your program had used up the {}: the notebook was started again after this cell."
NOT_RUN = "Not run when a class is marked: then the tests look at what your nodes do."
THREADS = "A thread of the notebook {} was still running after its last cell."


class NotebookRun:
    """The run of one notebook. `marking` receives its cells' results, outputs, flags and timings."""

    def __init__(self, marking: MarkingState, name: str) -> None:
        self._marking, self._name = marking, name
        self._exercises, self._results = marking.exercises[name], marking.cells[name]
        self._cells = _code_cells(marking.notebook(name))
        released = _code_cells(marking.task.release.notebooks[name])
        self._packages = imported_packages(released)
        sources = {cell.source for cell in released if not cell_name(cell)}
        plain = [(i, cell.source) for i, cell in enumerate(self._cells) if not cell_name(cell)]
        unchanged = {i for i, source in plain if source in sources}
        self._left = MAX_RESTARTS
        self._left_out: set[int] = set()  # cells in which a process ended, or that used up something
        self._greedy = -1  # the last cell that did so
        self._skipped = display_only_cells([cell.source for cell in self._cells], unchanged)

    def run_all(self) -> None:
        """Run all code cells in order. Where the process ends or has used up something, start it again."""
        began = monotonic()
        self._where = "before its first cell"
        self._session = self._marking.start_session()
        try:
            self._session.begin(self._marking.files, self._packages)
            self._marking.timings["start"] = monotonic() - began
            for index in range(len(self._cells)):
                self._run_and_restart(index)
            if self._session.threads_left:
                self._marking.flags.append(THREADS.format(quote(self._name)))
        except StudentProcessGone as gone:
            self._note_stop(gone)
        finally:
            self._session.close()

    def _run_and_restart(self, index: int) -> None:
        """Run a cell; afterwards there is a process for the next one. Raises StudentProcessGone."""
        cell, before = self._cells[index], self._session.used_up
        number = sum(bool(cell.source.strip()) for cell in self._cells[: index + 1])  # as Jupyter counts
        self._where = f"in {_cell_words(cell, number)}"
        try:
            self._run(self._session, cell, number, index)
        except StudentProcessGone as gone:
            if not self._can_restart(index):
                raise
            self._note_stop(gone, " It was started again.")
            self._restart(index)
            return
        used_up = self._session.used_up
        self._note_greedy(index, before)
        if used_up and is_test(cell) and self._can_restart(index):
            cell.outputs = [*cell.outputs, *_text(USED_UP.format(used_up))]
            who = "its nodes" if self._greedy == index else "the cells before it"
            self._flag(cell, [f"{who} used up the {used_up}, so the notebook was started again"])
            self._left_out.add(self._greedy)
            self._restart(index)

    def _can_restart(self, index: int) -> bool:
        """Return whether a new process may run the cells below, and there is a test among them."""
        in_time = self._session.over > monotonic()
        return self._left > 0 and in_time and any(map(is_test, self._cells[index + 1 :]))

    def _restart(self, index: int) -> None:
        """Start a new process, and run the cells up to this one in it again, but for tests."""
        self._left -= 1
        self._left_out.add(index)
        over = self._session.over
        self._session.close()
        self._session = self._marking.start_session()
        self._session.begin(self._marking.files, self._packages, over)
        number = last = 0
        try:
            for number, cell in enumerate(self._cells[: index + 1]):
                before = self._session.used_up
                runs = not (is_test(cell) or number in self._skipped or number in self._left_out)
                self._session.run(cell.source if runs else EMPTY_CELL, CellOutputs(DisplayRegistry()))
                last = number if runs else last
                self._note_greedy(number, before)
        except StudentProcessGone:
            if not self._can_restart(index):
                raise
            self._left_out |= {number, last}  # one that says quit() ends its process after it
            self._restart(index)
        else:
            if self._session.used_up and self._can_restart(index):  # by another cell than the first time
                self._left_out.add(self._greedy)
                self._restart(index)

    def _note_greedy(self, index: int, before: str) -> None:
        """Store which cell used something up. before: what was used up before it."""
        if self._session.used_up and not before:
            self._greedy = index

    def _note_stop(self, gone: StudentProcessGone, more: str = "") -> None:
        stop = f"The notebook {quote(self._name)} stopped {self._where}. {gone}{more}"
        if stop not in self._marking.stops:
            self._marking.stops.append(stop)

    def _run(self, session: StudentSession, cell: NotebookNode, number: int, index: int) -> None:
        skipped = index in self._skipped
        outputs, began = CellOutputs(self._marking.displays), monotonic()
        try:
            if is_test(cell):
                cell.outputs = self._test(session, cell, number, outputs)
            else:
                session.run(EMPTY_CELL if skipped else cell.source, outputs)
                if skipped:
                    outputs.add_line(NOT_RUN)
                cell.outputs = outputs.list
        except StudentProcessGone as gone:
            after = RESTARTED if self._can_restart(index) else NOT_RUN_BELOW
            outputs.add_line(f"The notebook stopped here. {gone} {after}")
            cell.outputs = outputs.list
            raise
        finally:
            cell.execution_count = number or None
            for output in cell.outputs:
                if output["output_type"] == "execute_result":
                    output["execution_count"] = number
            self._marking.timings[f"{self._name}/{cell.id}"] = monotonic() - began

    def _test(
        self, session: StudentSession, cell: NotebookNode, number: int, shown: CellOutputs
    ) -> list[dict[str, Any]]:
        """Judge the nodes of a test cell; returns the cell's outputs, which are the judge's own."""
        exercise = self._exercises[cell_name(cell)]
        if not self._marking.task.judges(cell_name(cell)):
            session.run(EMPTY_CELL, shown)
            return []
        if isinstance(exercise, PlainTest):
            return self._plain_test(session, cell, shown)
        tested = session.test(cell.source, exercise, shown, self._marking.secret)
        self._flag(cell, tested.flags)
        if tested.error is not None:
            return self._course_error(cell, tested.error)
        if tested.problem:
            return self._not_judged(cell, tested.problem, shown)
        if tested.score is None:
            self._results.append(no_points(cell, exercise))
            shown.add_line("No points: this cell ended before the nodes could be run.")
            return shown.list
        score, worth = tested.score, float(cell.metadata.nbgrader.points)
        self._marking.timings["judged"] += math.fsum(recording.stamp for recording in score.recordings)
        problems = score_outputs.alarms(score)
        look = [*score_outputs.spoofed_topics(score), *score_outputs.unused_offers(score)]
        if exercise.name in self._marking.variants:
            look += answered_variants(exercise, score)
        self._flag(cell, [*problems, *look])
        shown_score = score_outputs.for_student(score)
        self._results.append(score_outputs.cell_result(cell_name(cell), shown_score, worth, bool(problems)))
        converted = _text(score_outputs.conversion(shown_score, worth))
        return [*score_outputs.outputs(shown_score, number), *converted, *self._written(shown)]

    def _plain_test(
        self, session: StudentSession, cell: NotebookNode, shown: CellOutputs
    ) -> list[dict[str, Any]]:
        """Run a plain test in the student's process; returns its outputs."""
        session.run(cell.source, shown)
        result, problem = read_points(cell_name(cell), float(cell.metadata.nbgrader.points), shown.list)
        self._flag(cell, [problem] if problem else [])
        self._results.append(result)
        return shown.list

    def _course_error(self, cell: NotebookNode, error: Exception) -> list[dict[str, Any]]:
        """The result after an error of the course: the instructor has to look."""
        last = traceback.format_exception_only(error)[-1].strip()
        self._flag(cell, [f"could not be graded, because of a bug in the course: {last}"])
        self._marking.errors.append(writable_text(f"a bug in the course: {last}"))
        self._results.append(replace(no_points(cell, self._exercises[cell_name(cell)]), needs_look=True))
        words = (
            "This cell could not be graded, because of a bug in the course. Your instructor will look at it."
        )
        return _text(words)

    def _not_judged(self, cell: NotebookNode, problem: str, shown: CellOutputs) -> list[dict[str, Any]]:
        """The result if the student's process could not serve the nodes; the cells below are run."""
        self._flag(cell, [f"not graded, and worth a look. {problem.rstrip('.')}"])
        self._results.append(replace(no_points(cell, self._exercises[cell_name(cell)]), needs_look=True))
        words = f"No points: this could not be graded. {problem} Your instructor will look at it."
        return [*_text(words), *self._written(shown)]

    def _written(self, shown: CellOutputs) -> list[dict[str, Any]]:
        """Return what the nodes printed; in private worlds for the instructor alone: it may reveal them."""
        make = score_outputs.for_instructor if self._marking.secret else _text
        return make(shown.printed_text)

    def _flag(self, cell: NotebookNode, problems: Sequence[str]) -> None:
        name = f"The test cell {quote(cell_name(cell))}"
        self._marking.flags += [f"{name}: {writable_text(problem)}." for problem in problems]


def _text(text: str) -> list[dict[str, Any]]:
    line = text if text.endswith("\n") else f"{text}\n"
    return [{"output_type": "stream", "name": "stdout", "text": line}] if text else []


def _code_cells(notebook: NotebookNode) -> list[NotebookNode]:
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def _cell_words(cell: NotebookNode, number: int) -> str:
    name = cell_name(cell)
    return f"its cell {quote(name)}" if name else f"its code cell {number}"
