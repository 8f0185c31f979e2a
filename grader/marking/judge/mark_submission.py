"""Marks one submission: runs its notebooks in the student's processes, and judges the nodes they hand over.

This is the trusted side: simulator, companions, worlds from the secret and all judging are here.
"""

from __future__ import annotations

from dataclasses import replace
from time import monotonic

from nbformat import NotebookNode

from grader.exercise import Exercise
from grader.marking.errors import Unusable
from grader.marking.judge.marking_state import MarkingState, StartSession, cell_name, no_points
from grader.marking.judge.notebook_run import NotebookRun
from grader.marking.judge.personal_release import drawn_numbers, personal_release
from grader.marking.judge.plain_tests import PlainTest
from grader.marking.judge.testcells import exercise_names, find_exercise, is_test
from grader.marking.outputs import writable_text
from grader.marking.result import NotebookResult, Result
from grader.marking.submission.rebuild import rebuild_submission
from grader.marking.submission.suspicious_code import find_suspicious_code
from grader.marking.task import MarkingTask
from grader.seeds import secret_of_student

MAX_SUSPICIOUS = 20  # of a notebook that are reported


def draw_variants(marking: MarkingState) -> None:
    """Continue with the student's own release. Raises NoVariants if it can't be drawn."""
    release = marking.task.release
    marking.task = replace(marking.task, release=personal_release(release, marking.secret))
    marking.variants = drawn_numbers(release.notebooks.values(), marking.secret)


def rebuild_notebooks(marking: MarkingState) -> None:
    """Insert the student's answers into the release's notebooks. Raises Unusable if none can be marked."""
    marking.rebuilt = rebuild_submission(marking.task.submitted, marking.task.release)
    marking.flags += marking.rebuilt.flags


def find_exercises(marking: MarkingState) -> None:
    """Find the exercises of the test cells. Raises UnknownTest for a release that can't be marked here."""
    for name, released in marking.task.release.notebooks.items():
        names = exercise_names(released)
        marking.exercises[name] = {
            cell: _exercise(marking, full) if full else PlainTest(cell) for cell, full in names.items()
        }


def _exercise(marking: MarkingState, name: str) -> Exercise:
    """The exercise with this full name, in the student's variant."""
    found: Exercise = find_exercise(name)
    number = marking.variants.get(found.name)
    return found if number is None else found.variant(number)


def flag_suspicious_code(marking: MarkingState) -> None:
    """Flag suspicious code in a notebook that is not in the release itself."""
    for name, rebuilt in marking.rebuilt.notebooks.items():
        released = set(find_suspicious_code(_sources(marking.task.release.notebooks[name])))
        found = [flag for flag in find_suspicious_code(_sources(rebuilt.notebook)) if flag not in released]
        if len(found) > MAX_SUSPICIOUS:
            found[MAX_SUSPICIOUS:] = [f"There are {len(found) - MAX_SUSPICIOUS} more such things in it."]
        marking.flags += found


def run_and_judge(marking: MarkingState) -> None:
    """Run each notebook to its end, or as far as its process lives."""
    for name in marking.task.release.notebooks:
        marking.cells[name] = []
        if name in marking.rebuilt.notebooks:
            NotebookRun(marking, name).run_all()
        else:
            marking.stops.append(marking.rebuilt.missing[name])


def fill_in_missed_tests(marking: MarkingState) -> None:
    """Give no points for tests that were not reached."""
    for name, results in marking.cells.items():
        done = {result.cell for result in results}
        cells = marking.notebook(name).cells
        tests = [cell for cell in cells if is_test(cell) and marking.task.judges(cell_name(cell))]
        missed = [cell for cell in tests if cell_name(cell) not in done]
        results += [no_points(cell, marking.exercises[name][cell_name(cell)]) for cell in missed]
        order = [cell_name(cell) for cell in tests]
        results.sort(key=lambda result: order.index(result.cell))


STEPS = [draw_variants, rebuild_notebooks, find_exercises, flag_suspicious_code]
STEPS += [run_and_judge, fill_in_missed_tests]


def mark_submission(task: MarkingTask, secret: str, start_session: StartSession) -> Result:
    """Mark a submission with worlds and seeds from the secret and the student's name, or run its procedure.

    With the secret "", they are the public ones. Raises UnknownTest or NoVariants for a release that can't be
    marked here, and nothing else, whatever the submission does.
    """
    began = monotonic()
    marking = MarkingState(task, secret_of_student(secret, task.student), start_session)
    try:
        if task.procedure is None:
            for step in STEPS:
                step(marking)
        else:
            task.procedure.run(marking)
    except Unusable as reason:
        return Result(task.student, task.assignment, task.key, "refused", str(reason))
    marking.timings["total"] = monotonic() - began
    repaired = "repaired" if marking.rebuilt.repairs else "marked"
    result = Result(
        task.student,
        task.assignment,
        task.key,
        "stopped" if marking.stops else repaired,
        " ".join(marking.stops),
        marking.rebuilt.repairs,
        marking.flags,
        [NotebookResult(name, marking.notebook(name), cells) for name, cells in marking.cells.items()],
        marking.timings,
    )
    broken = bool(marking.errors) and not result.judged
    return replace(result, verdict="broken", reason=marking.errors[0]) if broken else result


def result_text(result: Result) -> str:
    """A result as JSON that every program can decode, whatever characters the student used."""
    return writable_text(result.to_json())


def _sources(notebook: NotebookNode) -> list[tuple[str, str]]:
    return [(cell_name(cell) or cell.id, cell.source) for cell in notebook.cells if cell.cell_type == "code"]
