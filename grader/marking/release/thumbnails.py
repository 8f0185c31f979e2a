"""Draws the picture of each lesson's goal, which the start page shows: course/NN_TOPIC/goal.svg.

Of a lesson with several notebooks, each has a picture: that of driving.ipynb is driving.svg.

    python -m grader.marking.release.thumbnails [NN_TOPIC ...]

It runs the lesson up to the cell that shows the goal, and draws that cell's recording. The cell is the first
one whose id begins with "goal" and whose last line shows a recording, or the one that `SHOWN` names.
"""
import argparse
import ast
import re
import sys
from collections.abc import Sequence
from pathlib import Path

import nbformat
from nbformat import NotebookNode

from grader.course_files.course_notebooks import course_order, picture_of
from grader.marking.errors import CommandFailed
from grader.marking.release.run_notebooks import execute_notebook

LESSONS = "course/[0-9][0-9]_*/*.ipynb"
# Lessons whose goal is a diagram: the cell that shows it later, and how it is drawn.
SHOWN = {
    "02_topics/connecting": ("together-topics", "graph"),
    "04_actions/driving": ("together-run", "world"),
    "05_sensing/guarding": ("whole-run", "world"),
    "06_navigator/lesson": ("avoid-maze-run", "world"),
    "06_navigator/navigating": ("whole-run", "world"),
    "13_delivery/faults": ("wrong-run", "world"),
    "14_localization/lesson": ("truth-run", "world"),
    "14_localization/covariance": ("whole-run", "world"),
    "14_localization/localization": ("whole-run", "world"),
    "15_races/threads": ("whole-run", "world"),
}
SVG = re.compile(r"<svg .*</svg>\n", re.DOTALL)


def draw_goal(lesson: Path) -> str:
    """The SVG of a lesson's goal. Raises CommandFailed if the lesson shows none, or can't be executed."""
    notebook = nbformat.read(lesson, 4)
    index, recording, drawing = find_goal(f"{lesson.parent.name}/{lesson.stem}", notebook.cells)
    notebook.cells = [cell for cell in notebook.cells[: index + 1] if cell.cell_type == "code"]
    last = notebook.cells[-1]
    code = f"from sim.view.thumbnail import thumbnail\nprint(thumbnail({recording}, {drawing!r}))"
    last.source = "\n".join([*_without_last(last.source), code])
    stopped = execute_notebook(notebook, lesson)
    text = "".join(output.get("text", "") for output in last.outputs)
    found = SVG.search(text)
    if found is None:
        raise CommandFailed(f"{lesson} shows no goal: {' '.join([*stopped, *_errors(notebook.cells)])}")
    return found[0]


def _errors(cells: Sequence[NotebookNode]) -> list[str]:
    outputs = [output for cell in cells for output in cell.outputs if output.output_type == "error"]
    return [f"{output.ename}: {output.evalue}" for output in outputs]


def find_goal(name: str, cells: Sequence[NotebookNode]) -> tuple[int, str, str]:
    """The index of the cell with the goal, the expression of its recording, and how to draw it.

    name: the lesson's folder and notebook, such as "04_actions/driving". Raises CommandFailed if there is no
    such cell.
    """
    wanted, drawing = SHOWN.get(name, ("", ""))
    for index, cell in enumerate(cells):
        if cell.cell_type != "code" or not (cell.id == wanted if wanted else cell.id.startswith("goal")):
            continue
        shown = _shown(cell.source)
        if shown:
            return index, shown[0], drawing or shown[1]
    which = f"the cell {wanted!r}" if wanted else 'a cell whose id begins with "goal"'
    raise CommandFailed(f"{name} has no picture: {which} must end with a replay or a plot of a recording")


def _shown(source: str) -> tuple[str, str] | None:
    """The expression of the recording that a cell's last line shows, and how to draw it."""
    last = _last(source)
    if not isinstance(last, ast.Expr) or not isinstance(last.value, ast.Call):
        return None
    call = last.value
    if isinstance(call.func, ast.Attribute) and call.func.attr == "replay":
        return ast.unparse(call.func.value), "world"
    if isinstance(call.func, ast.Name) and call.args and re.match("plot_|animate", call.func.id):
        return ast.unparse(call.args[0]), "graph" if call.func.id == "plot_graph" else "world"
    return None


def _last(source: str) -> ast.stmt | None:
    """The last statement; None for a cell that isn't Python, such as one with a magic."""
    try:
        body = ast.parse(source).body
    except SyntaxError:
        return None
    return body[-1] if body else None


def _without_last(source: str) -> list[str]:
    last = _last(source)
    assert last is not None, "find_goal has found a statement"
    return source.splitlines()[: last.lineno - 1]


def main(arguments: Sequence[str] | None = None) -> int:
    """Draw the goals of the named lessons, by default of all."""
    description = "Draw the picture of each lesson's goal."
    parser = argparse.ArgumentParser("python -m grader.marking.release.thumbnails", description=description)
    parser.add_argument("lessons", nargs="*", metavar="NN_TOPIC", help="default: all lessons")
    chosen = parser.parse_args(arguments).lessons
    for lesson in sorted(Path().glob(LESSONS), key=course_order):
        if chosen and lesson.parent.name not in chosen:
            continue
        try:
            picture_of(lesson).write_text(draw_goal(lesson), encoding="utf-8")
        except CommandFailed as error:
            print(error, file=sys.stderr)
            return 1
        print(picture_of(lesson))
    return 0


if __name__ == "__main__":
    sys.exit(main())
