"""Runs notebooks as they are, each in a copy of its folder, and collects their points and errors."""
import html
import os
import re
import shutil
import tempfile
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import nbformat
from nbclient.exceptions import DeadKernelError
from nbformat import NotebookNode
from nbgrader.utils import determine_grade, is_grade

from grader.course_files.notebook_client import notebook_client

# The start page lists exercises; page 10 of the bridge runs the navigator of lesson 6b.
READ_BY_OTHERS = "exercises", "06_navigator"
SECONDS_PER_CELL = 1800  # only against hanging: a busy machine compiles for minutes
KERNEL_OPTIONS = ["--IPKernelApp.log_level=40"]  # otherwise each kernel warns about its open ports


@dataclass(frozen=True)
class TestCellMark:
    """The points of a test cell. missed: the lines of its score that did not pass."""

    __test__ = False  # its name begins as a test's does, for pytest
    cell: str
    points: float
    most: float
    missed: tuple[str, ...] = ()


@dataclass(frozen=True)
class ExecutedNotebook:
    """A notebook that was run. problems: errors, each with its cell."""

    path: Path
    seconds: float
    marks: tuple[TestCellMark, ...] = ()
    problems: tuple[str, ...] = ()

    @property
    def points(self) -> float:
        """The points of all its test cells."""
        return sum(marks.points for marks in self.marks)

    @property
    def most(self) -> float:
        """The points that are possible."""
        return sum(marks.most for marks in self.marks)

    @property
    def is_right(self) -> bool:
        """Return whether it ran without errors and has all points."""
        return not self.problems and all(marks.points >= marks.most for marks in self.marks)


def run_notebooks(paths: Sequence[Path]) -> Iterator[ExecutedNotebook]:
    """Run the notebooks, as many at a time as there are cores; yield them in order."""
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        yield from pool.map(run_notebook, paths)


def run_notebook(path: Path) -> ExecutedNotebook:
    """Run a notebook to its end, even if cells raise. The file and its folder are not changed."""
    begin = time.monotonic()
    notebook, stopped = execute(path)
    problems = errors_of(notebook)
    marks = tuple(_marks(cell) for cell in notebook.cells if is_grade(cell) and cell.cell_type == "code")
    return ExecutedNotebook(path, time.monotonic() - begin, marks, (*problems, *stopped))


def execute(path: Path) -> tuple[NotebookNode, tuple[str, ...]]:
    """The notebook with its outputs, and why it stopped early, if it did. The file is not changed."""
    notebook = nbformat.read(path, 4)
    return notebook, execute_notebook(notebook, path)


def execute_notebook(notebook: NotebookNode, path: Path, start: str = "pass") -> tuple[str, ...]:
    """Execute a notebook as if it were the file at this path; returns why it stopped early, if it did.

    start: a line that its kernel runs before the first cell.
    """
    with tempfile.TemporaryDirectory() as place:
        # Lessons write files, and read others beside them.
        folder = Path(shutil.copytree(path.resolve().parent, Path(place, path.resolve().parent.name)))
        for beside in (path.resolve().parents[1] / name for name in READ_BY_OTHERS):
            if beside.is_dir() and not Path(place, beside.name).exists():
                Path(place, beside.name).symlink_to(beside)
        options = {
            "interrupt_on_timeout": True,
            "extra_arguments": [*KERNEL_OPTIONS, f"--IPKernelApp.exec_lines={start}"],
        }
        client = notebook_client(notebook, SECONDS_PER_CELL, **options)
        try:
            client.execute(cwd=str(folder))
        except DeadKernelError:
            return ("its kernel died.",)
    return ()


def errors_of(notebook: NotebookNode) -> list[str]:
    """A line for each error that a cell of an executed notebook raised."""
    return [problem for cell in notebook.cells for problem in _problems(cell)]


def _problems(cell: NotebookNode) -> Iterator[str]:
    for output in cell.get("outputs", ()):
        if output.output_type == "error":
            late = output.ename == "KeyboardInterrupt"
            error = f"stopped after {SECONDS_PER_CELL} s" if late else f"{output.ename}: {output.evalue}"
            yield f"cell {cell.id}: {error}".splitlines()[0]


def _marks(cell: NotebookNode) -> TestCellMark:
    points, most = determine_grade(cell)
    if cell.execution_count is None:
        points = 0.0  # the notebook was stopped before; nbgrader gives all points for no output
    pages = [output.get("data", {}).get("text/html", "") for output in cell.outputs]
    missed = tuple(line for page in pages for line in missed_lines(page)) if points < most else ()
    return TestCellMark(cell.metadata.nbgrader.grade_id, points, most, missed)


def missed_lines(page: str) -> list[str]:
    """The lines of a score's table that are neither passed nor headings, as text."""
    rows = (re.sub(r"</div>|</td>", "\n", row) for row in page.split("<tr>")[2:])
    texts = (html.unescape(re.sub(r"<[^>]+>", "", row)).strip() for row in rows)
    wrong = "\n".join(text for text in texts if not text.startswith("✔"))
    return [line.strip() for line in wrong.splitlines() if line.strip()]
