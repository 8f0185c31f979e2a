"""Finds the exercise that a test cell grades in the instructor's notebook, without running it."""

from __future__ import annotations

import ast
import importlib
from collections.abc import Iterable, Mapping
from typing import Any

from nbformat import NotebookNode

from grader.marking.errors import UnknownTest

HOME = "grader.exercises"


def exercise_names(notebook: NotebookNode) -> dict[str, str]:
    """The full name of the exercise by the grade_id of the test cell, in order; "" for a plain test.

    `topics.square.grade(Driver)` after `from grader.exercises import topics` is
    "grader.exercises.topics.square". Plain tests call no `grade`. Raises UnknownTest for any other test cell.
    """
    names = course_imports(cell.source for cell in notebook.cells if cell.cell_type == "code")
    return {
        cell.metadata.nbgrader.grade_id: _exercise_name(cell.source, names, cell.metadata.nbgrader.grade_id)
        for cell in notebook.cells
        if is_test(cell)
    }


def is_test(cell: Mapping[str, Any]) -> bool:
    """Return whether it is one of nbgrader's "autograded tests"."""
    settings = cell["metadata"].get("nbgrader", {})
    is_graded = bool(settings.get("grade")) and not settings.get("solution")
    return cell["cell_type"] == "code" and is_graded


def find_exercise(name: str) -> Any:
    """The exercise with this full name. Raises UnknownTest if there is none."""
    from grader.exercise import Exercise

    module, _, attribute = name.rpartition(".")
    try:
        found = getattr(importlib.import_module(module), attribute)
    except (ImportError, AttributeError):
        found = None
    if not isinstance(found, Exercise):
        saw = f"A test cell grades {name}, but there is no such exercise."
        raise UnknownTest(f"{saw} Is the release from this course?")
    return found


def course_imports(sources: Iterable[str]) -> dict[str, str]:
    """Return what the cells import from grader.exercises: full names by their local names."""
    found: dict[str, str] = {}
    for source in sources:
        for node in ast.walk(_parsed(source) or ast.Module([], [])):
            if isinstance(node, ast.ImportFrom) and not node.level and _inside(node.module or ""):
                found |= {each.asname or each.name: f"{node.module}.{each.name}" for each in node.names}
            elif isinstance(node, ast.Import):
                found |= {each.asname: each.name for each in node.names if each.asname and _inside(each.name)}
    return found


def imported_packages(cells: Iterable[Mapping[str, Any]]) -> list[str]:
    """The packages of exercises from which cells import, such as "grader.exercises.topics"."""
    parts = [name.split(".") for name in course_imports(cell["source"] for cell in cells).values()]
    return sorted({".".join(part[:3]) for part in parts})


def _exercise_name(source: str, names: dict[str, str], cell: str) -> str:
    parsed = _parsed(source) or ast.Module([], [])
    match parsed.body:
        case [ast.Expr(ast.Call(ast.Attribute(owner, "grade")))]:
            match owner:  # of a student's own release
                case ast.Call(ast.Attribute(varied, "variant"), [ast.Constant(int())], []):
                    owner = varied
            first, *rest = ast.unparse(owner).split(".")
            if first in names and all(part.isidentifier() for part in rest):
                return ".".join([names[first], *rest])
        case [_, *_] if not any(getattr(each, "attr", "") == "grade" for each in ast.walk(parsed)):
            return ""
    raise UnknownTest(
        f"The test cell `{cell}` can't be marked here: expected a line such as `topics.square.grade(Driver)` "
        f"and a cell that imports `topics` from {HOME}, or Python that calls no `grade`, such as "
        "`assert double(3) == 6`."
    )


def _parsed(source: str) -> ast.Module | None:
    try:
        return ast.parse(source)
    except (SyntaxError, ValueError):  # a command of IPython's, such as %matplotlib
        return None


def _inside(module: str) -> bool:
    return module == HOME or module.startswith(HOME + ".")
