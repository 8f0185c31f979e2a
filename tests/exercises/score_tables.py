"""What the score tables of all assignments share: pages of scores, and notebooks that were run.

An exercise has a folder, tests/exercises/<assignment>/<exercise>/, with a module of nodes, students.py, and a
page, page.txt, that says what each of the nodes earns and the red lines it gets, word by word.
Only the numbers of code lines read N: they change with every edit of the module. And what Python itself says
is said as by Python 3.12.

    python -m tests.exercises.score_tables nodes          writes the pages anew: read what changed
    python -m tests.exercises.score_tables nodes/heart    writes this one
"""

from __future__ import annotations

import functools
import html
import importlib
import re
import shutil
import sys
import tempfile
from pathlib import Path
from typing import Any, NamedTuple

import nbformat
from nbformat import NotebookNode

from grader import Exercise, Score
from grader.course_files.notebook_client import notebook_client
from sim import Process
from tests.exercises.builds import kept_builds
from tests.exercises.evidence import Evidence
from tests.students.teams import Team, programs_of

ROOT = Path(__file__).parents[2]
# What one Python says of an error, and another one: a student reads the words of the one that runs.
REWORDED = {
    "min() arg is an empty sequence": "min() iterable argument is empty",
    "float division by zero": "division by zero",
}
PAGE = "page.txt"
NOT_STARTED = "This exercise is not started yet"


class Miss(NamedTuple):
    """A red line of a score, word by word."""

    sentence: str
    expected: str
    saw: str
    hint: str


def misses(score: Score) -> tuple[Miss, ...]:
    """The red lines of a score; lines that others explain (skipped) are left out."""
    failed = [verdict for verdict in score.verdicts if verdict.status == "failed"]
    return tuple(Miss(it.sentence, it.expected, _without_numbers(it.saw), it.hint) for it in failed)


def _without_numbers(saw: str) -> str:
    for old, new in REWORDED.items():
        saw = saw.replace(old, new)
    saw = re.sub(r"/[^' ]*/install-\w+/", "install/", saw)  # where a package lies while it runs
    return re.sub(r"(, (?:at )?line) \d+", r"\1 N", saw)


def students(assignment: str, exercise: str) -> dict[str, Any]:
    """Name to node, for every node of an exercise's module but those in its PARTS."""
    module = importlib.import_module(f"tests.exercises.{assignment}.{exercise}.students")
    found = {
        name: item
        for name, item in vars(module).items()
        if isinstance(item, Process | Team) or getattr(item, "__module__", "") == module.__name__
    }
    return {name: item for name, item in found.items() if name not in getattr(module, "PARTS", ())}


@functools.cache
def page(assignment: str, exercise: str) -> dict[str, str]:
    """Name to what the exercise's page says of the node: points, and the red lines."""
    text = (folder_of(assignment, exercise) / PAGE).read_text(encoding="utf-8")
    return {block.split(":")[0]: block for block in text.strip().split("\n\n")}


def write_page(assignment: str, exercise: str) -> None:
    """Grade every node of an exercise, and write down what it gets."""
    judge = getattr(importlib.import_module(f"grader.exercises.{assignment}"), exercise)
    with kept_builds():
        nodes = students(assignment, exercise)
        blocks = [shown(name, judge.grade(*programs_of(node))) for name, node in nodes.items()]
    (folder_of(assignment, exercise) / PAGE).write_text("\n\n".join(blocks) + "\n", encoding="utf-8")
    page.cache_clear()


def folder_of(assignment: str, exercise: str) -> Path:
    """The folder with what proves an exercise: its students' nodes, its page, its rules."""
    return Path(__file__).with_name(assignment) / exercise


def with_pages() -> list[tuple[str, str]]:
    """The assignment and the name of each exercise that has a page."""
    return sorted(path.parts[-3:-1] for path in Path(__file__).parent.glob(f"*/*/{PAGE}"))


def shown(name: str, score: Score) -> str:
    """What a page says of a node."""
    lines = [f"{name}: {score!r}"]
    for miss in misses(score):
        lines.append(f"- {miss.sentence}")
        lines += [f"  Expected: {miss.expected}", f"  Saw: {miss.saw}", f"  Hint: {miss.hint}".rstrip()]
    lines += [f"- A mistake in the course: {verdict.alarm}" for verdict in score.broken]
    return "\n".join(lines)


class Answer(NamedTuple):
    """What a cell shows once the notebook has run."""

    source: str
    most: float  # points nbgrader can give for it; 0 for cells without
    points: float | None  # the number nbgrader reads, if there is one
    text: str  # printed text and tables as plain text
    problems: str  # errors, and whatever went to stderr


@functools.cache
def executed(folder: str, assignment: str) -> dict[str, Answer]:
    """What the code cells of an assignment's notebook show once it has run, by their ids.

    folder: "solutions", "exercises" or "course".
    """
    cells = notebook_run(folder, assignment).cells
    return {cell.id: _answer(cell) for cell in cells if cell.cell_type == "code"}


def notebook_run(folder: str, assignment: str) -> NotebookNode:
    """The notebook of an assignment, run to its end in a copy of its folder.

    assignment: or a lesson's notebook, such as "04_actions/driving".
    """
    name, _, stem = assignment.partition("/")
    evidence = Evidence.of_notebooks(folder, name)
    made = evidence.get(stem or "notebook", lambda: _run(ROOT / folder / name, stem or "*"))
    return nbformat.reads(made, 4)


def _run(beside: Path, stem: str) -> str:
    with tempfile.TemporaryDirectory() as place:
        copy = Path(shutil.copytree(beside, Path(place, beside.name)))  # lessons write files
        [path] = copy.glob(f"{stem}.ipynb")
        notebook = nbformat.read(path, 4)
        notebook_client(notebook, 600).execute(cwd=str(copy))
    return nbformat.writes(notebook)


def graded(folder: str, assignment: str) -> dict[str, Answer]:
    """The cells that give points."""
    return {name: answer for name, answer in executed(folder, assignment).items() if answer.most}


def _answer(cell: NotebookNode) -> Answer:
    said, problems, points = [], [], None
    for output in _joined(cell.outputs):
        if output.output_type == "error" or output.get("name") == "stderr":
            problems.append(output.get("text") or "\n".join(output.traceback))
            continue
        data = output.get("data", {})
        if output.output_type == "execute_result" and points is None:
            points = _number(data.get("text/plain", ""))
        said.append(output.get("text") or _plain(data.get("text/html", "")) or data.get("text/plain", ""))
    most = cell.metadata.get("nbgrader", {}).get("points", 0.0)
    return Answer(cell.source, most, points, "\n".join(said), "\n".join(problems))


def _joined(outputs: list[NotebookNode]) -> list[NotebookNode]:
    """The outputs, with what one print() wrote in one: a kernel may send it in pieces."""
    joined: list[NotebookNode] = []
    for output in outputs:
        before = joined[-1] if joined else {}
        if output.output_type == "stream" and output.name == before.get("name"):
            joined[-1] = NotebookNode(output | {"text": before["text"] + output.text})
        else:
            joined.append(output)
    return joined


def _number(text: str) -> float | None:
    return float(text) if re.fullmatch(r"\d+(\.\d+)?", text) else None


def _plain(page: str) -> str:
    return html.unescape(re.sub(r"<[^>]+>", " ", page))


def exercise_of(answer: Answer, exercises: Any) -> Exercise:
    """The exercise that a test cell such as `nodes.hello.grade(Hello)` grades."""
    return getattr(exercises, GRADES.fullmatch(answer.source)[1])


def graded_exercises(assignment: str) -> tuple[str, ...]:
    """The names of the exercises that the test cells of a notebook in solutions/ grade, in order."""
    (path,) = (ROOT / "solutions" / assignment).glob("*.ipynb")
    sources = [cell.source for cell in nbformat.read(path, 4).cells if cell.cell_type == "code"]
    return tuple(found[1] for source in sources if (found := GRADES.fullmatch(source)))


GRADES = re.compile(r"(?:\w+\.)?(\w+)\.grade\((.*)\)")


if __name__ == "__main__":
    for wanted in sys.argv[1:]:
        assignment, _, exercise = wanted.partition("/")
        for nodes in folder_of(assignment, exercise or "*").parent.glob(f"{exercise or '*'}/students.py"):
            write_page(assignment, nodes.parent.name)
