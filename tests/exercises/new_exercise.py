"""The files and cells of a new exercise, to be filled in: python -m tests.exercises --new TOPIC NAME"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import nbformat
from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_markdown_cell

from sim.suggestions import unknown_name

EXERCISE = '''"""In one line: what the student builds."""

from grader.checks import publishes
from grader.exercise import Exercise
from sim.evidence import Recording

{name} = Exercise("{name}", "A title of a few words", seconds=10)


@{name}.check(2)
def publishes_something(run: Recording) -> None:
    """The node publishes String messages on /{name}."""
    publishes(run, "/{name}", "std_msgs/msg/String")
'''
STUDENTS = '''"""Right nodes, and wrong ones named after their defect."""

from rclpy.node import Node


class {title}(Node):
    """Nothing is wrong with it; the others change one thing each."""

    def __init__(self):
        super().__init__("{name}")
'''
ANSWER = '''class {title}(Node):
    def __init__(self):
        super().__init__("{name}")
        # Missing: what the student writes.
        ### BEGIN SOLUTION
        ### END SOLUTION'''
SEE = '''recording = run({title}, seconds=10)
tell(recording)'''
HINTS = {"where to look": "...", "what to call": "...", "what to decide": "...?"}
POINTS = 2  # of the check above
LAST = "-points"  # the last cell of an exercise


def write_new(root: Path, topic: str, name: str) -> Iterator[str]:
    """Write what an exercise consists of; what was written and what is next, line by line.

    Raises FileExistsError for an exercise that is there, LookupError for a topic that isn't or a name that is
    no identifier.
    """
    notebook = _notebook(root, topic)
    if not re.fullmatch(r"[a-z][a-z0-9_]*", name):
        raise LookupError(f"expected a name in lower case, such as battery_level, and not {name!r}")
    exercise, proof = root / f"grader/exercises/{topic}/{name}.py", root / f"tests/exercises/{topic}/{name}"
    for path in (exercise, exercise.with_suffix(""), proof / "students.py"):
        if path.exists():
            raise FileExistsError(f"{path.relative_to(root)} is already there: choose another name")
    words = {"name": name, "title": "".join(word.title() for word in name.split("_"))}
    exercise.write_text(EXERCISE.format(**words), encoding="utf-8")
    proof.mkdir(exist_ok=True)
    (proof / "students.py").write_text(STUDENTS.format(**words), encoding="utf-8")
    add_cells(notebook, cells(topic, POINTS, **words))
    yield f"{exercise.relative_to(root)}: what it sends, its checks, its hints"
    yield f"{(proof / 'students.py').relative_to(root)}: three right nodes and six wrong ones, at least"
    yield f"{notebook.relative_to(root)}: six cells, {name}-task to {name}{LAST}, and its first table"
    yield f"then: make exercises, and python -m tests.exercises {topic}/{name}"


def _notebook(root: Path, topic: str) -> Path:
    found = {path.parent.name.partition("_")[2]: path for path in sorted(root.glob("solutions/*/*.ipynb"))}
    if topic not in found:
        raise LookupError(unknown_name("topic", topic, found))
    return found[topic]


def cells(
    topic: str, points: float, *, name: str, title: str, answer: str = ANSWER, see: str = SEE
) -> list[NotebookNode]:
    """The six cells of an exercise: task, answer, what it shows, hints, test."""
    words = {"name": name, "title": title}
    tools = {"grade": False, "grade_id": name, "locked": False, "schema_version": 3, "solution": True}
    tools |= {"task": False}
    tested = tools | {"grade": True, "grade_id": name + LAST, "locked": True, "points": points}
    tested |= {"solution": False}
    hints = (f"<details><summary>Hint {number}: {about}</summary>\n\n{text}\n\n</details>"
             for number, (about, text) in enumerate(HINTS.items(), 1))  # fmt: skip
    task = f"## A title ({points:g} points)\n\n**Task.** Write the node `{name}`."
    return [
        new_markdown_cell(task, id=f"{name}-task"),
        new_code_cell(answer.format(**words), id=name, metadata={"nbgrader": tools}),
        new_markdown_cell("**See it.** What the next cell shows.", id=f"{name}-see-text"),
        new_code_cell(see.format(**words), id=f"{name}-see"),
        new_markdown_cell("\n\n".join(hints), id=f"{name}-hints"),
        new_code_cell(f"{topic}.{name}.grade({title})", id=name + LAST, metadata={"nbgrader": tested}),
    ]


def add_cells(path: Path, added: list[NotebookNode]) -> None:
    """Put an exercise's cells behind those of the last one in a notebook."""
    notebook = nbformat.read(path, 4)
    ends = [number for number, cell in enumerate(notebook.cells, 1) if cell.id.endswith(LAST)]
    notebook.cells[ends[-1] : ends[-1]] = added
    nbformat.write(notebook, path)
