"""Reads a released assignment, such as exercises/01_nodes: its notebooks and other files."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

import nbformat
from nbformat import NotebookNode

from grader.marking.errors import CourseError
from grader.marking.submission.untrusted_folder import FILE, list_entries

SUFFIX = ".ipynb"
MAX_RELEASE_BYTES = 20_000_000  # of the files beside the notebooks


@dataclass(frozen=True)
class Release:
    """An assignment as it is handed out.

    notebooks: by name, without .ipynb. files: the bytes of its other files, by path. digest: of all of them.
    """

    assignment: str
    notebooks: Mapping[str, NotebookNode]
    files: Mapping[str, bytes] = field(default_factory=dict)
    digest: str = ""


def load_release(folder: Path) -> Release:
    """Read a release from its folder. Raises CourseError if it is too large."""
    paths = (entry.path for entry in list_entries(folder) if entry.kind == FILE)
    contents = {path: (folder / path).read_bytes() for path in paths if not is_hidden(path)}
    own = [path for path in contents if path.endswith(SUFFIX) and "/" not in path]
    files = {path: data for path, data in contents.items() if path not in own}
    if (size := sum(map(len, files.values()))) > MAX_RELEASE_BYTES:
        most = f"expected {MAX_RELEASE_BYTES / 1e6:g} at most"
        raise CourseError(f"the files in {folder} have {size / 1e6:.0f} MB; {most}")
    notebooks = {path.removesuffix(SUFFIX): nbformat.reads(contents[path].decode(), 4) for path in own}
    digest = digest_parts([part for pair in contents.items() for part in pair])
    return Release(folder.name, notebooks, files, digest)


def is_hidden(path: str) -> bool:
    """Return whether the path, or a folder in it, begins with a dot."""
    return any(part.startswith(".") for part in PurePosixPath(path).parts)


def digest_parts(parts: Sequence[str | bytes]) -> str:
    """Return one hexadecimal digest of a sequence; each part enters with its length."""
    digest = hashlib.sha256()
    for part in parts:
        data = part if isinstance(part, bytes) else part.encode(errors="surrogateescape")
        digest.update(b"%d:" % len(data))
        digest.update(data)
    return digest.hexdigest()
