"""The executed notebooks of the web site; a page is executed again only if what it uses has changed.

That is the code of its cells, the files beside it, and the packages that they import.
"""
import functools
import hashlib
import json
import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import nbformat
from nbformat import NotebookNode

from grader.course_files.course_notebooks import read_text
from grader.marking.errors import CommandFailed
from grader.marking.release import run_notebooks, site_sliders
from sim.course_folders import COURSE

ALWAYS = ("sim", "ros_packages", "requirements.lock")  # what every page uses
JUDGES = "grader"  # what those use that name it, but for its commands
COMMANDS = "grader/marking/"
RECORDER = [Path(site_sliders.__file__).with_suffix(suffix) for suffix in (".py", ".js")]
START = "from grader.marking.release.site_sliders import record_sliders; record_sliders()"


def executed_pages(
    course: Path, names: Sequence[Path], kept: Path, report: Callable[[str], None]
) -> Iterator[NotebookNode]:
    """The notebooks with their outputs, in order; as many are executed at a time as there are cores.

    kept: the folder with those of earlier builds. report: called with the name of each that is executed.
    Raises CommandFailed for one that can't be executed.
    """
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        yield from pool.map(lambda name: _executed(course, name, kept, report), names)


def _executed(course: Path, name: Path, kept: Path, report: Callable[[str], None]) -> NotebookNode:
    notebook: NotebookNode = nbformat.read(course / name, 4)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    digest = _digest(course / name, [cell.source for cell in code])
    record = kept / name.with_suffix(".json")
    known = json.loads(read_text(record) or "{}")
    if known.get("digest") != digest:
        report(str(name))
        stopped = run_notebooks.execute_notebook(notebook, course / name, START)
        problems = [*run_notebooks.errors_of(notebook), *stopped]
        if problems:
            raise CommandFailed(f"{course / name} could not be executed: {' '.join(problems)}")
        known = {"digest": digest, "outputs": [cell.outputs for cell in code]}
        record.parent.mkdir(parents=True, exist_ok=True)
        record.write_text(json.dumps(known), encoding="utf-8")
    for cell, outputs in zip(code, known["outputs"], strict=True):
        cell.outputs = [nbformat.from_dict(output) for output in outputs]
    return notebook


def _digest(page: Path, code: Sequence[str]) -> str:
    beside = [file for file in _files(page.parent) if file.suffix not in (".ipynb", ".svg")]
    own = b"\n".join([*(file.read_bytes() for file in beside), json.dumps(code).encode()])
    recorder = (file.read_bytes() for file in RECORDER)
    packages = ALWAYS + ((JUDGES,) if JUDGES.encode() in own else ())
    return hashlib.sha256(b"\n".join([own, *recorder, *map(_package_digest, packages)])).hexdigest()


@functools.cache
def _package_digest(name: str) -> bytes:
    digest = hashlib.sha256()
    for file in _files(COURSE / name):
        path = file.relative_to(COURSE).as_posix()
        if not path.startswith(COMMANDS):
            digest.update(b"\n".join([path.encode(), file.read_bytes()]))
    return digest.digest()


def _files(place: Path) -> list[Path]:
    """A file, or those in a folder and its folders, but for what Python leaves there."""
    found = sorted(place.rglob("*")) if place.is_dir() else [place]
    return [path for path in found if path.is_file() and "__pycache__" not in path.parts]
