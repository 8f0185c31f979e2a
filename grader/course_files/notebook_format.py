"""Normalizes notebooks, so that git diffs show only the author's changes.

    python -m grader.course_files.notebook_format [--check] [FILE or FOLDER ...]    default: course solutions

A normalized notebook has no outputs, execution counts or widget state, only relevant metadata, and an id on
every cell. Existing ids are kept, so inserting or moving a cell changes no other cell.
"""

import argparse
import difflib
import json
import re
import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import nbformat

FOLDERS = (Path("course"), Path("solutions"))
NOTEBOOK_METADATA = {
    "kernelspec": {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}
CELL_METADATA = {"deletable", "editable", "jupyter", "nbgrader", "tags"}  # jupyter: a hidden source
CELL_ID = re.compile(r"[a-zA-Z0-9_-]{1,64}")  # as the notebook format 4.5 allows
LINES_SHOWN = 12


class InvalidNotebook(ValueError):
    """A file that is not a valid notebook of format 4; the message has its name and the reason."""


def normalized(text: str, name: str) -> str:
    """Return the notebook `text` normalized; `name` is for errors. Raises InvalidNotebook."""
    try:
        notebook = json.loads(text)
    except json.JSONDecodeError as error:
        problem = f"{name} is not a notebook: expected JSON, saw {error}."
        raise InvalidNotebook(
            f"{problem} Is it incomplete, or does it contain merge conflict markers?"
        ) from None
    version = notebook.get("nbformat") if isinstance(notebook, dict) else None
    if version != 4:
        problem = f"{name}: expected notebook format 4, saw {version}."
        raise InvalidNotebook(f"{problem} Open and save it in JupyterLab.")
    notebook |= {"metadata": NOTEBOOK_METADATA, "nbformat_minor": 5}
    cells = notebook.setdefault("cells", [])
    for cell, cell_id in zip(cells, cell_ids(cells), strict=True):
        cell["id"] = cell_id
        metadata = cell.get("metadata", {})
        cell["metadata"] = {key: metadata[key] for key in metadata if key in CELL_METADATA}
        if cell.get("cell_type") == "code":
            cell |= {"outputs": [], "execution_count": None}
    node = nbformat.from_dict(notebook)
    try:
        nbformat.validate(node)
    except nbformat.ValidationError as error:
        problem = f"{name} is not a valid notebook: {str(error).splitlines()[0]}."
        raise InvalidNotebook(f"{problem} Repair it, or take it from git.") from None
    return f"{nbformat.writes(node)}\n"


def cell_ids(cells: Sequence[dict[str, Any]]) -> list[str]:
    """Return one id per cell: its own if it is valid and unique, else one from its grade_id or a number."""
    ids: list[str] = []
    reserved = {cell.get("id") for cell in cells}
    for cell in cells:
        own = cell.get("id")
        if not (isinstance(own, str) and CELL_ID.fullmatch(own) and own not in ids):
            own = next(new for new in _new_ids(cell) if new not in reserved)
            reserved.add(own)
        ids.append(own)
    return ids


def _new_ids(cell: dict[str, Any]) -> Iterator[str]:
    grade_id = cell.get("metadata", {}).get("nbgrader", {}).get("grade_id", "")
    stem = re.sub(r"[^a-zA-Z0-9_-]+", "-", grade_id)[:56]
    if stem:
        yield stem
    for number in range(1, 10**6):
        yield f"{stem or 'cell'}-{number}"


def find_notebooks(paths: Iterable[Path]) -> list[Path]:
    """Return the notebooks at or below `paths`, sorted. Raises InvalidNotebook for a missing path."""
    found: list[Path] = []
    for path in paths:
        if not path.exists():
            problem = f"Expected a notebook or a folder of notebooks at {path}, saw nothing there."
            raise InvalidNotebook(problem)
        found += path.rglob("*.ipynb") if path.is_dir() else [path]
    return sorted(path for path in found if ".ipynb_checkpoints" not in path.parts)


def normalize(paths: Iterable[Path], check: bool = False) -> list[str]:
    """Normalize the notebooks in `paths`, or with `check` only compare them.

    Returns one text per notebook that was not normalized: its name and the first lines that differ (- actual,
    + normalized). Raises InvalidNotebook.
    """
    reports = []
    for path in find_notebooks(paths):
        before = path.read_text(encoding="utf-8")
        after = normalized(before, str(path))
        if before == after:
            continue
        reports.append("\n    ".join([str(path), *_difference(before, after)]))
        if not check:
            path.write_text(after, encoding="utf-8")
    return reports


def _difference(before: str, after: str) -> list[str]:
    lines = list(difflib.unified_diff(before.splitlines(), after.splitlines(), n=0, lineterm=""))[2:]
    if not lines:
        return ["the file should end with one newline"]
    more = [f"... and {len(lines) - LINES_SHOWN} more lines"] if len(lines) > LINES_SHOWN else []
    return lines[:LINES_SHOWN] + more


def main(arguments: list[str] | None = None) -> int:
    """Run the command line; returns the exit status."""
    command = "python -m grader.course_files.notebook_format"
    parser = argparse.ArgumentParser(command, description="Keep notebooks in one form.")
    parser.add_argument("paths", nargs="*", type=Path, help="notebooks or folders")
    parser.add_argument("--check", action="store_true", help="change nothing; exit 1 if it should")
    chosen = parser.parse_args(arguments)
    try:
        reports = normalize(chosen.paths or [folder for folder in FOLDERS if folder.exists()], chosen.check)
    except InvalidNotebook as error:
        print(error, file=sys.stderr)
        return 1
    for report in reports:
        print(f"{'not normalized' if chosen.check else 'normalized'}: {report}")
    if chosen.check and reports:
        print("Run `make tidy` and commit what it changes.")
    return 1 if chosen.check and reports else 0


if __name__ == "__main__":
    sys.exit(main())
