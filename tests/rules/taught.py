"""What the course must teach: taught.toml. Writes TAUGHT.md: python -m tests.rules.taught

A row, [[row]], has

    subject     what must be taught
    cells       where it is taught, as "NOTEBOOK: CELL", such as "08_joints/lesson: seven"
    checks      the checks that look for it, as "TOPIC/EXERCISE: FUNCTION", or one of table.ERRORS
    missing     what is not exercised or not graded, in a sentence; required where there is no check
"""

from __future__ import annotations

import functools
import json
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass

from tests.exercises.seeds import exercise_of
from tests.rules.table import ERRORS, ROOT, TABLES

PAGE = TABLES / "TAUGHT.md"
HEAD = """# What must be taught, where it is taught, and what looks for it

Written by `python -m tests.rules.taught` from `taught.toml`.
"""


@dataclass(frozen=True)
class Row:
    """A row of the table."""

    subject: str
    cells: tuple[str, ...]
    checks: tuple[str, ...] = ()
    missing: str = ""


@functools.cache
def rows() -> tuple[Row, ...]:
    """All rows. Raises TypeError for a key that rows don't have."""
    data = tomllib.loads((TABLES / "taught.toml").read_text(encoding="utf-8"))
    lists = ("cells", "checks")
    return tuple(
        Row(**{key: tuple(value) if key in lists else value for key, value in row.items()})
        for row in data["row"]
    )


def problems(row: Row) -> Iterator[str]:
    """What is wrong with a row, as sentences."""
    if not row.cells:
        yield f"{row.subject}: no cell teaches it"
    for cell in row.cells:
        notebook, _, name = cell.partition(": ")
        if name not in _cells(notebook):
            yield f"{row.subject}: there is no cell {cell}"
    for check in row.checks:
        if not _is_check(check):
            yield f"{row.subject}: there is no check {check}"
    if not row.checks and not row.missing:
        yield f"{row.subject}: it has no check, and no reason"


@functools.cache
def _cells(notebook: str) -> frozenset[str]:
    path = ROOT / "course" / f"{notebook}.ipynb"
    found = json.loads(path.read_text(encoding="utf-8"))["cells"] if path.exists() else []
    return frozenset(cell["id"] for cell in found)


def _is_check(name: str) -> bool:
    place, _, function = name.partition(": ")
    topic, _, exercise = place.partition("/")
    try:
        checks = exercise_of(topic, exercise).checks
    except (ImportError, AttributeError):
        return False
    return function in ERRORS or function in {check.name for check in checks}


def render() -> str:
    """The page, as Markdown."""
    graded = sum(bool(row.checks) for row in rows())
    whole = sum(bool(row.checks) and not row.missing for row in rows())
    lines = [
        HEAD,
        f"{len(rows())} subjects: all are taught, {graded} are graded, {whole} of these in full.\n",
        "| | subject | cells | checks | missing |",
        "|--|--|--|--|--|",
    ]
    for number, row in enumerate(rows(), 1):
        cells, checks = ("<br>".join(f"`{item}`" for item in items) for items in (row.cells, row.checks))
        lines.append(f"| {number} | {row.subject} | {cells} | {checks} | {row.missing} |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    PAGE.write_text(render(), encoding="utf-8")
