"""The reference solutions: what the notebooks in solutions/ give to the exercises."""

from __future__ import annotations

import ast
import contextlib
import functools
import importlib
import re
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import nbformat
from nbformat import NotebookNode

from grader.course_files.course_notebooks import DISPLAYS
from tests.exercises.score_tables import ROOT

WRITES = "%%writefile "
NOT_DONE = {"play", *DISPLAYS}  # calls that run programs or show their source: nothing is run here


@functools.cache
def solution(
    topic: str, name: str, number: int | None = None, copied: int | None = None
) -> tuple[Any, ...]:
    """What the notebook gives to an exercise, as `grade` takes it.

    A workspace is the path of one in a folder that is there until the process ends. number: of the variant;
    None for the course's own notebook. copied: the number of the variant that the answers are copied from.
    """
    (path,) = ROOT.glob(f"solutions/*_{topic}/*.ipynb")
    notebook = nbformat.read(path, 4)
    if number is not None:
        exercise = getattr(importlib.import_module(f"grader.exercises.{topic}"), name)
        notebook = _variant(notebook, exercise.name, number, number if copied is None else copied)
    space: dict[str, Any] = {}
    with _in_a_folder():
        for cell in notebook.cells:
            _write(cell)
            for statement in _statements(cell):
                if graded := _graded(statement, name):
                    given = eval(f"({', '.join([*map(ast.unparse, graded.args), ''])})", space)
                    return tuple(str(Path(one).resolve()) if isinstance(one, str) else one for one in given)
                # What only shows something is left out, but not what writes a package that is given.
                if not _shows(statement) or "packages.write_" in ast.unparse(statement):
                    with contextlib.suppress(NameError):  # of a recording
                        exec(ast.unparse(statement), space)
    raise ValueError(f"{path} grades no {name}")


def _variant(notebook: NotebookNode, exercise: str, number: int, answered: int) -> NotebookNode:
    """The notebook with one variant of an exercise, and the answers of that one or another one."""
    from grader.marking.judge.personal_release import personal_notebook  # the rest is tried without marking

    answers = personal_notebook(notebook, {exercise: answered})
    notebook = personal_notebook(notebook, {exercise: number})
    for cell, answer in zip(notebook.cells, answers.cells, strict=True):
        if cell.metadata.get("nbgrader", {}).get("solution"):
            cell.source = answer.source
    return notebook


@functools.cache
def _folders() -> tempfile.TemporaryDirectory[str]:
    return tempfile.TemporaryDirectory(prefix="solutions-")


@contextlib.contextmanager
def _in_a_folder() -> Iterator[None]:
    folder = tempfile.mkdtemp(dir=_folders().name)
    sys.path.insert(0, folder)  # a notebook imports the modules that it writes
    try:
        with contextlib.chdir(folder):
            yield
    finally:
        sys.path.remove(folder)


def _write(cell: Any) -> None:
    first, _, rest = cell.source.partition("\n")
    if first.startswith(WRITES):
        path = Path(first.removeprefix(WRITES).strip())
        path.parent.mkdir(parents=True, exist_ok=True)
        sys.modules.pop(path.stem, None)  # of the same notebook in another variant
        path.write_text(rest + "\n", encoding="utf-8")


def _statements(cell: Any) -> list[ast.stmt]:
    """What a cell executes, without its runs; nothing of a cell with commands of IPython."""
    with contextlib.suppress(SyntaxError):
        statements = ast.parse(cell.source if cell.cell_type == "code" else "").body
        return [statement for statement in statements if not _runs(statement)]
    return []


def _graded(statement: ast.stmt, name: str) -> ast.Call | None:
    """The call of `grade` of the exercise of this name, if the statement is one."""
    call = getattr(statement, "value", None)
    function = ast.unparse(call.func) if isinstance(call, ast.Call) else ""
    words = re.sub(r"\.variant\(\d+\)", "", function).split(".")
    return call if words[-2:] == [name, "grade"] else None


def _shows(statement: ast.stmt) -> bool:
    """Whether it is an expression, or a loop that only prints."""
    if isinstance(statement, ast.For):
        return all(_shows(line) and ast.unparse(line).startswith("print(") for line in statement.body)
    return isinstance(statement, ast.Expr)


def _runs(statement: ast.stmt) -> bool:
    if isinstance(statement, ast.FunctionDef):  # such as a test, which runs programs only when it is called
        return False
    called = (part.func for part in ast.walk(statement) if isinstance(part, ast.Call))
    return any(ast.unparse(function) in NOT_DONE for function in called)
