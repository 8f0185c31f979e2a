"""Reads what a student handed in, once: all that lies there, and what is in the assignment's notebooks.

Nothing of a submission is run here, and whatever lies in its folder, no exception but Unusable leaves.
"""

import hashlib
import os
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

import nbformat
from nbformat import NotebookNode

from grader.marking.errors import CourseError, Unusable
from grader.marking.handed_in.cells import PlainNotebook, read_notebook
from grader.marking.handed_in.folder import FILE, FOLDER, FolderEntry, list_entries, read_file
from grader.marking.handed_in.words import list_names, quote
from grader.workspace.sources import Refused, read_files

LARGEST = 128_000_000  # bytes of a notebook's file
MOST_CANDIDATES = 20
SUFFIX = ".ipynb"
SILENT = {"timestamp.txt"}  # nbgrader's own
WORKSPACE = "ws"  # the folder that assignments on packages write
DATA = 20_000_000  # bytes of the files that a release may bring along


@dataclass(frozen=True)
class Release:
    """An assignment as it is handed out.

    notebooks: by name, without .ipynb. files: the bytes of its other files, by path. digest: of all that.
    """

    assignment: str
    notebooks: Mapping[str, NotebookNode]
    files: Mapping[str, bytes] = field(default_factory=dict)
    digest: str = ""


@dataclass(frozen=True)
class HandedIn:
    """All of a student's folder that matters for a mark: plain data, the same on every machine.

    contents: by path, the bytes of each file that is one of the assignment's notebooks or may stand for one,
    or why it can't be read. problem: why the folder itself can't be, or "". workspace: the files of packages
    beside the notebook, by path from there; or why they can't be taken.
    """

    entries: tuple[FolderEntry, ...] = ()
    contents: Mapping[str, bytes | str] = field(default_factory=dict)
    problem: str = ""
    workspace: Mapping[str, bytes] | str = field(default_factory=dict)


@dataclass(frozen=True)
class Submission:
    """What was handed in: notebooks by the release's names, and a sentence for each thing that was odd.

    missing: a sentence for each notebook of the release that could not be read, by its name.
    """

    notebooks: dict[str, PlainNotebook]
    missing: dict[str, str] = field(default_factory=dict)
    repairs: list[str] = field(default_factory=list)


def load_release(folder: Path) -> Release:
    """Read a release, such as exercises/01_nodes. Raises CourseError if it is too large."""
    there = {path: (folder / path).read_bytes() for path in sorted(_files(folder))}
    own = {path for path in there if path.endswith(SUFFIX) and "/" not in path}
    files = {path: data for path, data in there.items() if path not in own}
    if (size := sum(map(len, files.values()))) > DATA:
        most = f"expected {DATA / 1e6:g} at most"
        raise CourseError(f"the files in {folder} have {size / 1e6:.0f} MB; {most}")
    notebooks = {path.removesuffix(SUFFIX): nbformat.reads(there[path].decode(), 4) for path in sorted(own)}
    return Release(folder.name, notebooks, files, _digest([item for pair in there.items() for item in pair]))


def read_folder(folder: Path, release: Release) -> HandedIn:
    """Read what was handed in for `release`: whatever lies there, this raises nothing."""
    try:
        there = tuple(list_entries(folder))
    except Unusable as reason:
        return HandedIn(problem=str(reason))
    own = [name + SUFFIX for name in release.notebooks]
    paths = [*(path for path in own if os.path.lexists(folder / path)), *_candidates(there, own)]
    return HandedIn(
        there, {path: _content(folder, path) for path in paths}, workspace=_workspace(folder)
    )


def submission_key(handed_in: HandedIn, release: Release, secret_fingerprint: str, version: str) -> str:
    """Return a hexadecimal digest of all that decides a mark: equal keys, equal marks."""
    there = [f"{entry.path} {entry.kind}" for entry in handed_in.entries if entry.path not in SILENT]
    contents = [item for path in sorted(handed_in.contents) for item in (path, handed_in.contents[path])]
    about = [secret_fingerprint, version, release.digest, handed_in.problem]
    packages = handed_in.workspace
    told = [packages] if isinstance(packages, str) else [item for pair in packages.items() for item in pair]
    return _digest([*about, f"{len(there)}", *there, *contents, *told])


def read_submission(handed_in: HandedIn, release: Release) -> Submission:
    """Find the notebooks of `release` in it. Raises Unusable if none of them can be read."""
    if handed_in.problem:
        raise Unusable(handed_in.problem)
    used: dict[str, str] = {}
    found = Submission({})
    for name in release.notebooks:
        try:
            used[name] = _path(name, handed_in, release)
            found.notebooks[name] = _read(handed_in, used[name])
        except Unusable as reason:
            found.missing[name] = str(reason)
            continue
        if used[name] != name + SUFFIX:
            found.repairs.append(f"{quote(used[name])} was taken for {quote(name + SUFFIX)}.")
    if not found.notebooks:
        raise Unusable(" ".join(found.missing.values()))
    if isinstance(handed_in.workspace, str):
        found.repairs.append(f"No file of your workspace was taken. {handed_in.workspace}")
    taken = {*used.values(), WORKSPACE} if handed_in.workspace else set(used.values())
    if left := list(_unused(handed_in.entries, taken, release)):
        found.repairs.append(f"Handed in beside the notebook and not used: {list_names(left)}.")
    return found


def _workspace(folder: Path) -> Mapping[str, bytes] | str:
    """The sources in a workspace beside the notebook, by path from there; or why they can't be taken."""
    try:
        if (folder / WORKSPACE).is_symlink():
            raise Refused(f"`{WORKSPACE}` is a link. Hand in the folder itself.")
        found = read_files(folder / WORKSPACE / "src", f"{WORKSPACE}/src")
    except Refused as reason:
        return str(reason)
    return {f"{WORKSPACE}/src/{path}": data for path, data in found.items()}


def _content(folder: Path, path: str) -> bytes | str:
    try:
        return read_file(folder, path, LARGEST)
    except Unusable as reason:
        return str(reason)


def _read(handed_in: HandedIn, path: str) -> PlainNotebook:
    content = handed_in.contents[path]
    if isinstance(content, str):
        raise Unusable(content)
    return read_notebook(content, path)


def _digest(parts: Sequence[str | bytes]) -> str:
    digest = hashlib.sha256()
    for part in parts:
        data = part if isinstance(part, bytes) else part.encode(errors="surrogateescape")
        digest.update(b"%d:" % len(data))
        digest.update(data)
    return digest.hexdigest()


def _files(folder: Path) -> frozenset[str]:
    files = (entry.path for entry in list_entries(folder) if entry.kind == FILE)
    return frozenset(path for path in files if not _hidden(path))


def _path(name: str, handed_in: HandedIn, release: Release) -> str:
    """Where the notebook `name` lies: under its own name, or the only other one that holds its cells."""
    file = name + SUFFIX
    if file in handed_in.contents:
        return file
    own = {other + SUFFIX for other in release.notebooks}
    candidates = [path for path in handed_in.contents if path not in own]
    if not candidates:
        raise Unusable(f"Expected the notebook {quote(file)}, saw none. Hand it in under this name.")
    fitting = [path for path in candidates if _holds(handed_in, path, release.notebooks[name])]
    if len(fitting) == 1:
        return fitting[0]
    saw = f"only {list_names(candidates)}, without its cells"
    if fitting:
        saw = f"{list_names(fitting)}, more than one"
    raise Unusable(f"Expected the notebook {quote(file)}, saw {saw}. Hand in one under this name.")


def _candidates(there: Sequence[FolderEntry], own: Collection[str]) -> Iterator[str]:
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


def _holds(handed_in: HandedIn, path: str, notebook: NotebookNode) -> bool:
    """Whether the file holds at least half of the named cells of `notebook`."""
    try:
        cells = _read(handed_in, path).cells
    except Unusable:
        return False
    names = {cell.metadata.nbgrader.grade_id for cell in notebook.cells if "nbgrader" in cell.metadata}
    return 2 * len(names & {word for cell in cells for word in (cell.name, cell.id)}) >= len(names)


def _unused(there: Sequence[FolderEntry], used: Collection[str], release: Release) -> Iterator[str]:
    """What else lies there; folders as a whole."""
    known = {path.partition("/")[0] for path in (*used, *release.files, *SILENT)}
    for entry in there:
        if "/" not in entry.path and entry.path not in known:
            yield f"{entry.path}/" if entry.kind == FOLDER else entry.path


def _hidden(path: str) -> bool:
    return any(part.startswith(".") for part in PurePosixPath(path).parts)
