"""Reads what a student handed in: which of its files are the assignment's notebooks, and what is in them.

Nothing of a submission is run here, and whatever lies in its folder, no exception but Unusable leaves.
"""

import hashlib
import os
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

import nbformat
from nbformat import NotebookNode

from grader.marking.mending.folder import FILE, FOLDER, Entry, entries, read_file
from grader.marking.mending.sheet import Sheet, read_sheet
from grader.marking.mending.words import Unusable, listed, quoted

LARGEST = 128_000_000  # bytes of a notebook's file
MOST_CANDIDATES = 20
SUFFIX = ".ipynb"
SILENT = {"timestamp.txt"}  # nbgrader's own


@dataclass(frozen=True)
class Release:
    """An assignment as it is handed out.

    notebooks: by name, without .ipynb. data: the paths of its other files.
    """

    notebooks: Mapping[str, NotebookNode]
    data: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Submission:
    """What was handed in: notebooks by the release's names, and a sentence for each thing that was odd.

    missing: a sentence for each notebook of the release that could not be read, by its name.
    """

    sheets: dict[str, Sheet]
    missing: dict[str, str] = field(default_factory=dict)
    repairs: list[str] = field(default_factory=list)


def load(folder: Path) -> Release:
    """Read the release of an assignment, such as exercises/01_nodes."""
    notebooks = {path.stem: nbformat.read(path, 4) for path in sorted(folder.glob(f"*{SUFFIX}"))}
    return Release(notebooks, _files(folder) - {name + SUFFIX for name in notebooks})


def read(folder: Path, release: Release) -> Submission:
    """Read what was handed in for `release`. Raises Unusable if none of its notebooks can be read."""
    there = entries(folder)
    used: dict[str, str] = {}
    found = Submission({})
    for name in release.notebooks:
        try:
            used[name] = _path(name, folder, there, release)
            found.sheets[name] = read_sheet(read_file(folder, used[name], LARGEST), used[name])
        except Unusable as reason:
            found.missing[name] = str(reason)
            continue
        if used[name] != name + SUFFIX:
            found.repairs.append(f"{quoted(used[name])} was taken for {quoted(name + SUFFIX)}.")
    if not found.sheets:
        raise Unusable(" ".join(found.missing.values()))
    if left := list(_unused(there, set(used.values()), release)):
        found.repairs.append(f"Handed in beside the notebook and not used: {listed(left)}.")
    return found


def submission_key(folder: Path, release: Path, secret_fingerprint: str, version: str) -> str:
    """Return a hexadecimal digest of all that decides a mark: equal keys, equal marks.

    Whatever lies in `folder`, this gives a key and raises nothing.
    """
    digest = hashlib.sha256()
    notebooks = frozenset(path.name for path in release.glob(f"*{SUFFIX}"))
    parts = (*_contents(release, _files(release)), "submission", *_contents(folder, notebooks))
    for part in (secret_fingerprint, version, *parts):
        data = part if isinstance(part, bytes) else part.encode(errors="surrogateescape")
        digest.update(b"%d:" % len(data))
        digest.update(data)
    return digest.hexdigest()


def _contents(folder: Path, files: Collection[str]) -> Iterator[str | bytes]:
    """What lies in a folder, and the bytes of `files` and of whatever may stand for one of them."""
    try:
        there = [entry for entry in entries(folder) if entry.path not in SILENT]
    except Unusable as reason:
        yield str(reason)
        return
    yield from (f"{entry.path} {entry.kind}" for entry in there)
    for path in sorted([*files, *_candidates(there, files)]):
        try:
            yield read_file(folder, path, LARGEST)
        except Unusable as reason:
            yield str(reason)


def _files(folder: Path) -> frozenset[str]:
    files = (entry.path for entry in entries(folder) if entry.kind == FILE)
    return frozenset(path for path in files if not _hidden(path))


def _path(name: str, folder: Path, there: Sequence[Entry], release: Release) -> str:
    """Where the notebook `name` lies: under its own name, or the only other one that holds its cells."""
    file = name + SUFFIX
    if os.path.lexists(folder / file):
        return file
    own = {other + SUFFIX for other in release.notebooks}
    candidates = list(_candidates(there, own))
    if not candidates:
        raise Unusable(f"Expected the notebook {quoted(file)}, saw none. Hand it in under this name.")
    fitting = [path for path in candidates if _holds(folder, path, release.notebooks[name])]
    if len(fitting) == 1:
        return fitting[0]
    saw = f"{listed(fitting)}, more than one" if fitting else f"only {listed(candidates)}, without its cells"
    raise Unusable(f"Expected the notebook {quoted(file)}, saw {saw}. Hand in one under this name.")


def _candidates(there: Sequence[Entry], own: Collection[str]) -> Iterator[str]:
    """Notebooks under other names than the release's: some, and together no more than can be read soon."""
    found = size = 0
    for entry in there:
        if entry.kind != FILE or not entry.path.lower().endswith(SUFFIX) or _hidden(entry.path):
            continue
        if entry.path in own or (found and size + entry.size > LARGEST):
            continue
        found, size = found + 1, size + entry.size
        if found > MOST_CANDIDATES:
            return
        yield entry.path


def _holds(folder: Path, path: str, notebook: NotebookNode) -> bool:
    """Whether the file holds at least half of the named cells of `notebook`."""
    try:
        cells = read_sheet(read_file(folder, path, LARGEST), path).cells
    except Unusable:
        return False
    names = {cell.metadata.nbgrader.grade_id for cell in notebook.cells if "nbgrader" in cell.metadata}
    return 2 * len(names & {word for cell in cells for word in (cell.name, cell.id)}) >= len(names)


def _unused(there: Sequence[Entry], used: Collection[str], release: Release) -> Iterator[str]:
    """What else lies there; folders as a whole."""
    known = {path.partition("/")[0] for path in (*used, *release.data, *SILENT)}
    for entry in there:
        if "/" not in entry.path and entry.path not in known:
            yield f"{entry.path}/" if entry.kind == FOLDER else entry.path


def _hidden(path: str) -> bool:
    return any(part.startswith(".") for part in PurePosixPath(path).parts)
