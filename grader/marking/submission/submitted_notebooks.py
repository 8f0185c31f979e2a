"""Finds the release's notebooks among the files of a submission, under their own names or others."""

import re
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from nbformat import NotebookNode

from grader.marking.errors import Unusable
from grader.marking.submission.assignment_release import SUFFIX, Release
from grader.marking.submission.plain_cells import PlainNotebook, read_notebook
from grader.marking.submission.quoting import list_names, quote
from grader.marking.submission.submitted_files import IGNORED_FILES, WORKSPACE, SubmittedFiles
from grader.marking.submission.untrusted_folder import FOLDER, FolderEntry

LEFT_BESIDE = ("__pycache__", ".ipynb_checkpoints")  # by Python and JupyterLab
WRITES = re.compile(r"^%%writefile +(?:-a +)?(?:\./)?([^\s/]+)[ \t]*$", re.MULTILINE)


@dataclass(frozen=True)
class SubmittedNotebooks:
    """The notebooks of a submission by the release's names, and a sentence for each thing that was odd.

    missing: a sentence for each notebook of the release that could not be read, by its name.
    """

    notebooks: dict[str, PlainNotebook]
    missing: dict[str, str] = field(default_factory=dict)
    repairs: list[str] = field(default_factory=list)


def read_notebooks(submitted: SubmittedFiles, release: Release) -> SubmittedNotebooks:
    """Read the notebooks of `release`. Raises Unusable if none of them can be read."""
    if submitted.problem:
        raise Unusable(submitted.problem)
    used: dict[str, str] = {}
    found = SubmittedNotebooks({})
    for name in release.notebooks:
        try:
            used[name] = _path(name, submitted, release)
            found.notebooks[name] = _read(submitted, used[name])
        except Unusable as reason:
            found.missing[name] = str(reason)
            continue
        if used[name] != name + SUFFIX:
            found.repairs.append(f"{quote(used[name])} was used as {quote(name + SUFFIX)}.")
    if not found.notebooks:
        raise Unusable(" ".join(found.missing.values()))
    if isinstance(submitted.workspace, str):
        found.repairs.append(f"No file of your workspace was used. {submitted.workspace}")
    taken = {*used.values(), *_written(found.notebooks.values()), *LEFT_BESIDE}
    taken |= {WORKSPACE} if submitted.workspace else set()
    if left := list(_unused(submitted.entries, taken, release)):
        found.repairs.append(f"Handed in alongside the notebook and not used: {list_names(left)}.")
    return found


def _read(submitted: SubmittedFiles, path: str) -> PlainNotebook:
    content = submitted.contents[path]
    if isinstance(content, str):
        raise Unusable(content)
    return read_notebook(content, path)


def _path(name: str, submitted: SubmittedFiles, release: Release) -> str:
    """The path of the notebook `name`: its own name, or that of the only other notebook with its cells."""
    file = name + SUFFIX
    if file in submitted.contents:
        return file
    own = {other + SUFFIX for other in release.notebooks}
    candidates = [path for path in submitted.contents if path not in own]
    if not candidates:
        raise Unusable(f"Expected the notebook {quote(file)}, saw none. Hand it in under this name.")
    fitting = [path for path in candidates if _has_cells(submitted, path, release.notebooks[name])]
    if len(fitting) == 1:
        return fitting[0]
    saw = f"only {list_names(candidates)}, without its cells"
    if fitting:
        saw = f"{list_names(fitting)}, more than one"
    raise Unusable(f"Expected the notebook {quote(file)}, saw {saw}. Hand in one under this name.")


def _has_cells(submitted: SubmittedFiles, path: str, notebook: NotebookNode) -> bool:
    """Return whether the file has at least half of the named cells of `notebook`."""
    try:
        cells = _read(submitted, path).cells
    except Unusable:
        return False
    names = {cell.metadata.nbgrader.grade_id for cell in notebook.cells if "nbgrader" in cell.metadata}
    return 2 * len(names & {name for cell in cells for name in (cell.name, cell.id)}) >= len(names)


def _written(notebooks: Iterable[PlainNotebook]) -> Iterator[str]:
    """The files that cells of the notebooks write: they lie beside a notebook that was run."""
    for notebook in notebooks:
        for cell in notebook.cells:
            yield from WRITES.findall(cell.text)


def _unused(entries: Sequence[FolderEntry], used: Collection[str], release: Release) -> Iterator[str]:
    """The other files of the submission; folders as a whole."""
    known = {path.partition("/")[0] for path in (*used, *release.files, *IGNORED_FILES)}
    for entry in entries:
        if "/" not in entry.path and entry.path not in known:
            yield f"{entry.path}/" if entry.kind == FOLDER else entry.path
