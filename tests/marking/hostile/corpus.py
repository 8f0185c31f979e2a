"""A class with a student for every trick, and three who are honest.

A trick is a small file in tests/students/hostile/, named by what it does: cells that take the place of an
answer (`# %% square`) or come after it (`# %% after square`). Other tricks damage the notebook or the folder;
they are functions here. Where a trick doesn't touch it, the answer to `temperature` is right and worth 15
points, and `square` is not begun: a trick that works would show in the points.

tests/marking/hostile/corpus.txt says what each gets, word by word.

    python -m tests.marking.hostile.corpus    writes the page anew: read what changed, then commit
"""

from __future__ import annotations

import copy
import json
import os
import re
import shutil
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

import nbformat
from nbformat import NotebookNode

from grader.marking.pool import Pool
from grader.marking.release.make_exercises import release
from grader.marking.release.samples import submission
from grader.marking.result import Result
from grader.marking.submission.assignment_release import load_release
from grader.marking.submission.submitted_files import read_folder
from grader.marking.task import MarkingTask, TimeLimits

ROOT = Path(__file__).parents[3]
PAGE = Path(__file__).with_name("corpus.txt")
ASSIGNMENT, NAME = "02_small", "topics.ipynb"
SECRET = "a secret of this test"
HONEST = {"honest_right": 1.0, "honest_half": 0.5, "honest_starter": 0.0}
KEPT = re.compile(r"setup|(temperature|square)(-points)?")
# Whom a limit of wall time stops; all others have the usual limits, which no busy machine reaches.
WITHOUT_END = ("endless_loop", "fake_clock", "leftover_thread", "nodes_without_end", "print_flood")
QUICK = TimeLimits(cell=15.0, test=15.0)


def course(folder: Path) -> Path:
    """Write a course with one assignment, two exercises of 02_topics, and release it."""
    shutil.copy(ROOT / "nbgrader_config.py", folder)
    notebook = nbformat.read(ROOT / "solutions" / "02_topics" / NAME, 4)
    notebook.cells = [cell for cell in notebook.cells if KEPT.fullmatch(cell.id)]
    source = folder / "solutions" / ASSIGNMENT / NAME
    source.parent.mkdir(parents=True)
    nbformat.write(notebook, source)
    (folder / ".secret").touch(mode=0o600)
    (folder / ".secret").write_text(SECRET)
    release(folder)
    return folder


def submit(folder: Path, names: list[str] | None = None) -> list[str]:
    """Hand in for everybody, or for those named; returns their names."""
    starter = nbformat.read(folder / "exercises" / ASSIGNMENT / NAME, 4)
    solution = nbformat.read(folder / "solutions" / ASSIGNMENT / NAME, 4)
    half = submission(solution, starter, 0.5)
    makers: dict[str, Callable[[Path], None]] = {
        name: _writer(submission(solution, starter, share)) for name, share in HONEST.items()
    }
    for file in sorted((ROOT / "tests" / "students" / "hostile").glob("*.py")):
        makers[file.stem] = _writer(with_trick(half, file.read_text(encoding="utf-8")))
    for trick in DAMAGES:
        makers[trick.__name__] = lambda place, trick=trick: trick(place, copy.deepcopy(half))
    chosen = {name: make for name, make in makers.items() if names is None or name in names}
    for name, make in chosen.items():
        place = folder / "class" / "submitted" / name / ASSIGNMENT
        place.mkdir(parents=True)
        make(place)
    return list(chosen)


def _writer(notebook: NotebookNode) -> Callable[[Path], None]:
    return lambda place: nbformat.write(notebook, place / NAME)


def with_trick(notebook: NotebookNode, text: str) -> NotebookNode:
    """The notebook with the cells of a trick's file."""
    notebook = copy.deepcopy(notebook)
    for part in re.split(r"^# %% ", text, flags=re.M)[1:]:
        where, source = part.split("\n", 1)
        name = where.removeprefix("after ")
        index = next(i for i, cell in enumerate(notebook.cells) if cell.id == name)
        if where == name:
            notebook.cells[index].source = source.strip()
        else:
            notebook.cells.insert(index + 1, nbformat.v4.new_code_cell(source.strip(), id="extra"))
    return notebook


def limits_of(name: str) -> TimeLimits:
    """The limits with which a submission is marked: what has no end is not waited for as long as usual."""
    return QUICK if name in WITHOUT_END else TimeLimits()


def mark(folder: Path, names: Sequence[str], jobs: int = 2) -> dict[str, Result]:
    """Mark those who handed in; name to result."""
    submitted, released = folder / "class" / "submitted", load_release(folder / "exercises" / ASSIGNMENT)
    read = {name: read_folder(submitted / name / ASSIGNMENT, released) for name in names}
    tasks = [MarkingTask(name, released, submitted, "00") for name, submitted in read.items()]
    found = {}
    for limits in (TimeLimits(), QUICK):
        some = [task for task in tasks if limits_of(task.student) == limits]
        if some:
            with Pool(jobs, secret=SECRET, time_limits=limits) as pool:
                found |= {result.student: result for result in pool.mark(some)}
    return {name: found[name] for name in names}


def block(result: Result) -> str:
    """What the page says of one submission."""
    cells = [cell for notebook in result.notebooks for cell in notebook.cells]
    points = ", ".join(f"{cell.exercise} {cell.points:g}" for cell in cells) or "nothing"
    lines = [f"{result.student}: {points} - {result.verdict}"]
    lines += [f"  Reason: {result.reason}"] if result.reason else []
    lines += [f"  Repair: {sentence}" for sentence in result.repairs]
    lines += [f"  Flag: {sentence}" for sentence in result.flags]
    return "\n".join(lines)


def page() -> dict[str, str]:
    """Name to what the page says of a submission."""
    return blocks(PAGE)


def blocks(file: Path) -> dict[str, str]:
    """Name to what a page of such a class says of a submission."""
    found = file.read_text(encoding="utf-8").strip().split("\n\n")
    return {text.split(":")[0]: text for text in found}


# -- tricks with the notebook, and damage -----------------------------------------------------------


def _cell(notebook: NotebookNode, name: str) -> NotebookNode:
    return next(cell for cell in notebook.cells if cell.id == name)


def skip_execution(place: Path, notebook: NotebookNode) -> None:
    """A tag lets nbclient pass over the test cell, which nbgrader takes for full marks."""
    _cell(notebook, "square-points").metadata["tags"] = ["skip-execution"]
    nbformat.write(notebook, place / NAME)


def edited_test_cell(place: Path, notebook: NotebookNode) -> None:
    """The test cell says what one would like to have."""
    _cell(notebook, "square-points").source = "18.0"
    nbformat.write(notebook, place / NAME)


def duplicated_test_cell(place: Path, notebook: NotebookNode) -> None:
    """The test cell is there twice: by copy and paste, in good faith."""
    notebook.cells.append(copy.deepcopy(_cell(notebook, "square-points")))
    notebook.cells[-1].id = "copy"
    nbformat.write(notebook, place / NAME)


def deleted_test_cell(place: Path, notebook: NotebookNode) -> None:
    """The test cell is gone."""
    notebook.cells.remove(_cell(notebook, "square-points"))
    nbformat.write(notebook, place / NAME)


def more_points(place: Path, notebook: NotebookNode) -> None:
    """The notebook's own metadata promise more points."""
    _cell(notebook, "square-points").metadata["nbgrader"]["points"] = 1800
    nbformat.write(notebook, place / NAME)


def forged_outputs(place: Path, notebook: NotebookNode) -> None:
    """The test cell comes with a result."""
    output = nbformat.v4.new_output("execute_result", {"text/plain": "18.0"}, execution_count=1)
    _cell(notebook, "square-points").outputs = [output]
    nbformat.write(notebook, place / NAME)


def graded_answer_cell(place: Path, notebook: NotebookNode) -> None:
    """The answer's cell says that it is a test cell itself."""
    _cell(notebook, "square").metadata["nbgrader"] |= {"grade": True, "points": 18, "solution": False}
    _cell(notebook, "square").source = "18.0"
    nbformat.write(notebook, place / NAME)


def script_in_markdown(place: Path, notebook: NotebookNode) -> None:
    """A text cell with a script for the instructor's browser."""
    notebook.cells.append(nbformat.v4.new_markdown_cell("<script>steal()</script>", id="words"))
    nbformat.write(notebook, place / NAME)


def broken_json(place: Path, notebook: NotebookNode) -> None:
    """The file ends in the middle."""
    (place / NAME).write_text(nbformat.writes(notebook)[:2000])


def empty_file(place: Path, notebook: NotebookNode) -> None:
    """The file is empty."""
    (place / NAME).touch()


def missing_notebook(place: Path, notebook: NotebookNode) -> None:
    """Nothing but a text was handed in."""
    (place / "answers.txt").write_text("42")


def renamed_notebook(place: Path, notebook: NotebookNode) -> None:
    """The browser gave the file another name."""
    nbformat.write(notebook, place / "topics (1).ipynb")


def wrong_kernel(place: Path, notebook: NotebookNode) -> None:
    """The notebook asks for a kernel that is not there."""
    notebook.metadata["kernelspec"] = {"name": "ir", "display_name": "R", "language": "R"}
    nbformat.write(notebook, place / NAME)


def shadowing_libraries(place: Path, notebook: NotebookNode) -> None:
    """Files beside the notebook have the names of libraries."""
    nbformat.write(notebook, place / NAME)
    for name in ("matplotlib.py", "sitecustomize.py", "grader.py", "ipykernel_launcher.py"):
        (place / name).write_text("raise SystemExit('18.0')")


def linked_solution(place: Path, notebook: NotebookNode) -> None:
    """The notebook is a link to the instructor's solution."""
    (place / NAME).symlink_to(place.parents[3] / "solutions" / ASSIGNMENT / NAME)


def linked_secret(place: Path, notebook: NotebookNode) -> None:
    """A file beside the notebook is a link to the secret."""
    nbformat.write(notebook, place / NAME)
    (place / "secret.txt").symlink_to(place.parents[3] / ".secret")


def hard_linked_secret(place: Path, notebook: NotebookNode) -> None:
    """The notebook is another name of the secret's file, as an archive can make one."""
    (place / NAME).hardlink_to(place.parents[3] / ".secret")


def notebooks_without_end(place: Path, notebook: NotebookNode) -> None:
    """Beside the notebook lie 25 GB of others, which take no room on the disk."""
    nbformat.write(notebook, place / "topics (1).ipynb")
    for number in range(200):
        (place / f"topics (1)({number}).ipynb").touch()
        os.truncate(place / f"topics (1)({number}).ipynb", 127_000_000)


def deep_attribute(place: Path, notebook: NotebookNode) -> None:
    """An attribute of an attribute, and so on, that a search of the source can't write out."""
    notebook.cells.append(nbformat.v4.new_code_cell(f"lambda a: a{'.b' * 400}.run_cell", id="extra"))
    nbformat.write(notebook, place / NAME)


def magic_lines(place: Path, notebook: NotebookNode) -> None:
    """Lines of IPython's own: it looks through the cell anew for each."""
    notebook.cells.append(nbformat.v4.new_code_cell("if False:\n" + "    %a\n" * 500, id="extra"))
    nbformat.write(notebook, place / NAME)


def huge_outputs(place: Path, notebook: NotebookNode) -> None:
    """The notebook was saved with 30 MB of output."""
    output = nbformat.v4.new_output("stream", name="stdout", text="x" * 30_000_000)
    _cell(notebook, "temperature").outputs = [output]
    nbformat.write(notebook, place / NAME)


def other_types(place: Path, notebook: NotebookNode) -> None:
    """Answers and metadata are of types that a notebook doesn't have."""
    data = json.loads(nbformat.writes(notebook))
    data["metadata"], data["cells"][0]["metadata"] = None, []
    data["cells"].append({"cell_type": "code", "source": 7, "metadata": {"nbgrader": "x"}})
    (place / NAME).write_text(json.dumps(data))


DAMAGES = (
    skip_execution,
    edited_test_cell,
    duplicated_test_cell,
    deleted_test_cell,
    more_points,
    forged_outputs,
    graded_answer_cell,
    script_in_markdown,
    broken_json,
    empty_file,
    missing_notebook,
    renamed_notebook,
    wrong_kernel,
    shadowing_libraries,
    linked_solution,
    linked_secret,
    hard_linked_secret,
    notebooks_without_end,
    deep_attribute,
    magic_lines,
    huge_outputs,
    other_types,
)


def write_page() -> None:
    """Mark everybody, and write down what each gets."""
    with tempfile.TemporaryDirectory() as folder:
        names = submit(course(Path(folder)))
        results = mark(Path(folder), names)
    PAGE.write_text("\n\n".join(map(block, results.values())) + "\n", encoding="utf-8")


if __name__ == "__main__":
    write_page()
