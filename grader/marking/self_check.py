"""Checks that this machine marks correctly, before a class is marked: a right answer and a wrong one."""

import nbformat
from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_notebook

from grader.marking.errors import SandboxFailed
from grader.marking.submission.assignment_release import Release
from grader.marking.submission.submitted_files import SubmittedFiles
from grader.marking.task import MarkingTask, TaskPool

NAME = "self_check"
RIGHT, WRONG = "a right answer", "a wrong answer"
SETUP = """\
from rclpy.node import Node
from std_msgs.msg import String
from grader.exercises import topics
"""
ANSWER = """\
class Greeter(Node):
    def __init__(self):
        super().__init__("greeter")
        self.publisher = self.create_publisher(String, "/greeting", 10)
        self.create_timer({period}, lambda: self.publisher.publish(String(data="Hello!")))
"""
TEST = "topics.greeting.grade(Greeter)"
POINTS = 8
ANSWERS = {RIGHT: ANSWER.format(period=0.5), WRONG: ANSWER.format(period=2.0)}
EXPECTED = {RIGHT: {"passed"}, WRONG: {"passed", "failed"}}  # the verdicts


def check_marking(pool: TaskPool) -> None:
    """Mark both answers as submissions. Raises SandboxFailed if their verdicts aren't those expected."""
    for result in pool.mark([_task(name, answer) for name, answer in ANSWERS.items()]):
        verdicts = [one for note in result.notebooks for cell in note.cells for one in cell.verdicts]
        if {verdict["status"] for verdict in verdicts} != EXPECTED[result.student]:
            missed = [f"expected {one['expected']}, saw {one['saw']}" for one in verdicts if one["expected"]]
            why = [*missed, "" if verdicts else result.why_not_judged, "all checks passed"]
            raise SandboxFailed(
                f"This machine doesn't mark correctly: {result.student} to the exercise greeting got "
                f"{result.points:g} of {POINTS} points ({next(filter(None, why)).rstrip('.')}). "
                "No submission was marked: repair the installation, or use another machine."
            )


def _task(name: str, answer: str) -> MarkingTask:
    submitted = nbformat.writes(_notebook(answer)).encode()
    release = Release(NAME, {NAME: _notebook("")})
    return MarkingTask(name, release, SubmittedFiles(contents={f"{NAME}.ipynb": submitted}), "0" * 64)


def _notebook(answer: str) -> NotebookNode:
    def cell(name: str, source: str, **settings: object) -> NotebookNode:
        about = {"grade_id": name, "schema_version": 3, "task": False, "locked": False, **settings}
        made: NotebookNode = new_code_cell(source, id=name, metadata={"nbgrader": about})
        return made

    notebook: NotebookNode = new_notebook(
        cells=[
            new_code_cell(SETUP, id="setup"),
            cell("answer", answer, solution=True, grade=False),
            cell("test", TEST, solution=False, grade=True, points=POINTS),
        ]
    )
    return notebook
