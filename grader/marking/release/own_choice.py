"""Leaves out exercises of the course, changes points and draws variants, as class/course.toml says.

    ["01_nodes"]
    leave_out = ["heart", "weather"]
    points = { counter = 10 }
    variants = true

An exercise is named by its test cell, `heart-points`, without `-points`; it is the section with that cell.
"""
import ast
import re
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from nbformat import NotebookNode
from nbgrader.preprocessors import NbGraderPreprocessor
from nbgrader.utils import is_grade
from traitlets import Unicode

from grader.marking.errors import CourseError
from grader.marking.judge.personal_release import tag
from grader.marking.submission.sections import section_around

FILE = Path("class", "course.toml")
LEAVE_OUT, POINTS, VARIANTS = "leave_out", "points", "variants"
NUMBER = re.compile(r"## (\d+)\. ")
WORTH = re.compile(r"\(\d+(?:\.\d+)? points?\)$", re.M)
ROW_END = re.compile(r"\| *\d+(?:\.\d+)? *\|$")


class OwnChoice(NbGraderPreprocessor):  # type: ignore[misc]
    """The first step of nbgrader's `generate_assignment`."""

    file = Unicode(str(FILE), help="the instructor's choice").tag(config=True)

    def preprocess(self, nb: NotebookNode, resources: dict[str, Any]) -> tuple[NotebookNode, dict[str, Any]]:
        """Apply the choice to a notebook with answers. Raises CourseError."""
        choice = read_choice(Path(self.file)).get(resources["nbgrader"]["assignment"], {})
        return choose(nb, choice, resources["nbgrader"]["assignment"]), resources


def read_choice(file: Path) -> dict[str, dict[str, Any]]:
    """The choice by assignment; {} without a file. Raises CourseError."""
    try:
        found = tomllib.loads(file.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return {}
    except (OSError, ValueError) as error:
        raise CourseError(f"{file} can't be read ({error})") from None
    for name, choice in found.items():
        left, points = choice.get(LEAVE_OUT, []), choice.get(POINTS, {})
        numbers = isinstance(points, dict) and all(type(each) in (int, float) for each in points.values())
        known = isinstance(left, list) and numbers and isinstance(choice.get(VARIANTS, True), bool)
        if choice.keys() - {LEAVE_OUT, POINTS, VARIANTS} or not known:
            expected = f'{LEAVE_OUT} = ["hello"], {POINTS} = {{ counter = 10 }} and {VARIANTS} = true'
            raise CourseError(f"{file}: expected lines such as {expected} below [{name!r}], saw {choice}")
    return found


def choose(notebook: NotebookNode, choice: Mapping[str, Any], assignment: str) -> NotebookNode:
    """The notebook with its choice. Raises CourseError for exercises that aren't there or are needed."""
    tests = {_name(cell): at for at, cell in enumerate(notebook.cells) if is_grade(cell)}
    for name in (*choice.get(LEAVE_OUT, []), *choice.get(POINTS, {})):
        if name not in tests:
            known = ", ".join(tests)
            raise CourseError(f"{FILE}: {assignment} has no exercise {name!r}: it has {known}")
    for name, points in choice.get(POINTS, {}).items():
        test = notebook.cells[tests[name]]
        test.metadata.nbgrader.points = points
        heading = notebook.cells[section_around(notebook.cells, tests[name]).start]
        _set_row(notebook, heading, ROW_END, f"| {points:g} |")
        heading.source = WORTH.sub(f"({points:g} points)", heading.source, count=1)
    sections = {name: section_around(notebook.cells, tests[name]) for name in choice.get(LEAVE_OUT, [])}
    left = {at for section in sections.values() for at in section}
    if left:
        _check_alone(notebook, sections, left)
    for section in sections.values():
        _set_row(notebook, notebook.cells[section.start], re.compile(r"^.*\n?", re.S), "")
    notebook.cells = [cell for at, cell in enumerate(notebook.cells) if at not in left]
    if choice.get(VARIANTS):
        tag(notebook, assignment)
    return notebook


def _name(cell: NotebookNode) -> str:
    return str(cell.metadata.nbgrader.grade_id).removesuffix("-points")


def _set_row(notebook: NotebookNode, heading: NotebookNode, part: re.Pattern[str], text: str) -> None:
    """Replace a part of the exercise's row in the table on top, if there is one."""
    number = NUMBER.match(heading.source)
    lines = notebook.cells[0].source.splitlines(keepends=True)
    for at, line in enumerate(lines):
        if number and line.startswith(f"| {number[1]} |"):
            end = "\n" * line.endswith("\n")
            new = part.sub(text, line.rstrip("\n"), count=1)
            lines[at] = new + end if new else ""
    notebook.cells[0].source = "".join(lines)


def _check_alone(notebook: NotebookNode, sections: Mapping[str, range], left: set[int]) -> None:
    """Raise CourseError if a cell that stays uses what a section defines."""
    code = {at: cell.source for at, cell in enumerate(notebook.cells) if cell.cell_type == "code"}
    rest = [source for at, source in code.items() if at not in left]
    stored, used = ({name for text in rest for name in names(text)} for names in (_defined, _used))
    for name, section in sections.items():
        texts = [code[at] for at in section if at in code]
        needed = sorted({each for text in texts for each in _defined(text)} & (used - stored))
        if needed:
            uses = f"other cells use `{needed[0]}`, which it defines"
            raise CourseError(f"{FILE}: {name!r} can't be left out: {uses}")


def _defined(source: str) -> Iterator[str]:
    """The names that a cell defines."""
    for node in _statements(source):
        if isinstance(node, ast.ClassDef | ast.FunctionDef):
            yield node.name
        elif isinstance(node, ast.Import | ast.ImportFrom):
            yield from ((each.asname or each.name).split(".")[0] for each in node.names)
        else:
            yield from (each.id for each in ast.walk(node) if _is_name(each, ast.Store))  # type: ignore[attr-defined]


def _used(source: str) -> Iterator[str]:
    """The names that a cell uses and doesn't bind itself."""
    nodes = [each for node in _statements(source) for each in ast.walk(node)]
    bound = {each.arg for each in nodes if isinstance(each, ast.arg)}
    bound |= {each.id for each in nodes if _is_name(each, ast.Store)}  # type: ignore[attr-defined]
    yield from (each.id for each in nodes if _is_name(each, ast.Load) and each.id not in bound)  # type: ignore[attr-defined]


def _is_name(node: ast.AST, context: type[ast.expr_context]) -> bool:
    return isinstance(node, ast.Name) and isinstance(node.ctx, context)


def _statements(source: str) -> list[ast.stmt]:
    """The statements of a cell, without IPython's commands; [] if it isn't Python."""
    try:
        return ast.parse("\n".join(line for line in source.splitlines() if line[:1] not in ("%", "!"))).body
    except SyntaxError:
        return []
