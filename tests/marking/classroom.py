"""A class that has handed in an assignment, and results of marking it, made without running anything."""
import copy
import hashlib
import shutil
from pathlib import Path
from typing import Any

import nbformat
from nbformat import NotebookNode
from nbgrader.api import Gradebook

from grader.marking.command.task_reader import TaskReader
from grader.marking.gradebook.course import Course
from grader.marking.gradebook.find_submissions import find_submissions
from grader.marking.release.make_exercises import release
from grader.marking.result import CellResult, NotebookResult, Result
from grader.marking.submission.assignment_release import load_release
from grader.marking.task import MarkingTask
from tests.marking.tiny import ROOT, answer, grade

ASSIGNMENT = "01_class"
NOTEBOOK = "nodes"
POINTS = {"test_counter": 4.0, "test_line": 6.0}
WRITTEN = "essay"


def essay(source: str = "### BEGIN SOLUTION\nBecause.\n### END SOLUTION") -> NotebookNode:
    """A written answer, which an instructor marks by hand with up to 5 points."""
    settings = {"grade_id": WRITTEN, "grade": True, "solution": True, "locked": False, "points": 5}
    more = {"schema_version": 3, "task": False, "cell_type": "markdown"}
    return nbformat.v4.new_markdown_cell(source, id=WRITTEN, metadata={"nbgrader": {**settings, **more}})


def classroom(folder: Path) -> Course:
    """Make a course with one assignment, released and in the gradebook."""
    cells = [
        nbformat.v4.new_code_cell("from grader.exercises import nodes", id="set-up"),
        answer("counter", "### BEGIN SOLUTION\nCounter = 1\n### END SOLUTION"),
        grade("test_counter", POINTS["test_counter"], "nodes.counter.grade(Counter)"),
        answer("line", "### BEGIN SOLUTION\nLine = 2\n### END SOLUTION"),
        grade("test_line", POINTS["test_line"], "nodes.line.grade(Line)"),
        essay(),
    ]
    source = folder / "solutions" / ASSIGNMENT / f"{NOTEBOOK}.ipynb"
    source.parent.mkdir(parents=True)
    shutil.copy(ROOT / "nbgrader_config.py", folder)
    nbformat.write(nbformat.v4.new_notebook(cells=cells), source)
    course = Course(folder)
    release(folder)
    return course


def submit(course: Course, *students: str, line: str = "Line = 2", time: str = "") -> None:
    """Hand in the assignment for these students: the counter answered, the line with this answer."""
    for student in students:
        notebook = released(course)
        for cell in notebook.cells:
            answers = {"counter": "Counter = 1", "line": line, WRITTEN: f"{student} thinks so."}
            cell.source = answers.get(cell.id, cell.source)
        folder = course.submitted(student, ASSIGNMENT)
        folder.mkdir(parents=True, exist_ok=True)
        nbformat.write(notebook, folder / f"{NOTEBOOK}.ipynb")
        if time:
            (folder / "timestamp.txt").write_text(time)


def gradebook(course: Course) -> dict[str, dict[str, Any]]:
    """All that the gradebook says of each student's submission, without the names of its rows."""
    with Gradebook(course.database, course.name) as book:
        return {found.student.id: _summary(found) for found in book.assignment_submissions(ASSIGNMENT)}


def _summary(submission: Any) -> dict[str, Any]:
    grades = [grade.to_dict() for note in submission.notebooks for grade in note.grades]
    comments = [comment.to_dict() for note in submission.notebooks for comment in note.comments]
    rows = [{**row, "id": ""} for row in (*grades, *comments)]
    penalties = [note.late_submission_penalty for note in submission.notebooks]
    about = {"time": str(submission.timestamp), "score": submission.score, "penalties": penalties}
    return about | {row["name"] + ("" if "auto_score" in row else " comment"): row for row in rows}


def released(course: Course) -> NotebookNode:
    return nbformat.read(course.release(ASSIGNMENT) / f"{NOTEBOOK}.ipynb", 4)


def tasks(course: Course, secret: str = "") -> list[MarkingTask]:
    """The tasks of marking what lies there now, sorted by student."""
    reader = TaskReader(load_release(course.release(ASSIGNMENT)), secret)
    return [reader.read(*submission) for submission in find_submissions(course, ASSIGNMENT).items()]


def result(course: Course, task: MarkingTask, **changes: Any) -> Result:
    """What marking gives, from the submission's own bytes: the same each time, different points for each."""
    notebook = nbformat.reads(task.submitted.contents[f"{NOTEBOOK}.ipynb"].decode(), 4)
    cells = []
    for cell in notebook.cells:
        if cell.id in POINTS:
            exercise, most = cell.id.removeprefix("test_"), POINTS[cell.id]
            share = hashlib.sha256(f"{task.key} {cell.id}".encode()).digest()[0] % 5 / 4
            cells.append(CellResult(cell.id, exercise, most * share, most, [verdict(exercise, most, share)]))
            message = f"{exercise}: {most * share:g} of {most:g}"
            cell.outputs = [nbformat.v4.new_output("stream", text=message)]
    note = NotebookResult(NOTEBOOK, copy.deepcopy(notebook), cells)
    values = {"verdict": "marked", "notebooks": [note], "timings": {"total": 0.5, "nodes/test_line": 0.25}}
    return Result(task.student, task.assignment, task.key, **{**values, **changes})


def verdict(exercise: str, points: float, credit: float, **changes: Any) -> dict[str, Any]:
    """One check's verdict, as in a result."""
    status = "passed" if credit == 1 else "failed"
    words = ("a line each second", f"{credit * 8:g} lines in 8 s", "Look at the timer.")
    words = words if status == "failed" else ("", "", "")
    texts = dict(zip(("expected", "saw", "hint"), words, strict=True))
    base = {"name": f"{exercise}_time", "sentence": "It keeps time.", "points": points, "credit": credit}
    rest = {"picture": "", "alarm": "", "run": 0, "earned": points * credit}
    return {**base, "status": status, **texts, **rest, **changes}
