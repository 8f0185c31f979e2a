"""Reads all files of a submission that decide its mark, and computes the key that names them.

Nothing of a submission is run here. Whatever is in its folder, no exception but Unusable is raised.
"""

import os
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from grader.marking.errors import Unusable
from grader.marking.submission.assignment_release import SUFFIX, Release, digest_parts, is_hidden
from grader.marking.submission.untrusted_folder import FILE, FolderEntry, list_entries, read_file
from grader.workspace.sources import InvalidFiles, read_files

MAX_NOTEBOOK_BYTES = 128_000_000
MAX_CANDIDATES = 20  # notebooks under other names that are read
IGNORED_FILES = {"timestamp.txt", "submission_secret.txt"}  # nbgrader's own
WORKSPACE = "ws"  # the folder that assignments on packages write


@dataclass(frozen=True)
class SubmittedFiles:
    """Everything in a student's folder that matters for a mark: plain data, the same on every machine.

    contents: by path, the bytes of each file that is, or may be, one of the assignment's notebooks; or why it
    can't be read. problem: why the folder itself can't be read, or "". workspace: the files of packages
    beside the notebook, by path in the folder; or why they can't be used.
    """

    entries: tuple[FolderEntry, ...] = ()
    contents: Mapping[str, bytes | str] = field(default_factory=dict)
    problem: str = ""
    workspace: Mapping[str, bytes] | str = field(default_factory=dict)


def read_folder(folder: Path, release: Release) -> SubmittedFiles:
    """Read a submission for `release`. Raises nothing, whatever the folder contains."""
    try:
        entries = tuple(list_entries(folder))
    except Unusable as reason:
        return SubmittedFiles(problem=str(reason))
    own = [name + SUFFIX for name in release.notebooks]
    paths = [*(path for path in own if os.path.lexists(folder / path)), *_candidates(entries, own)]
    contents = {path: _content(folder, path) for path in paths}
    return SubmittedFiles(entries, contents, workspace=_workspace(folder))


def submission_key(submitted: SubmittedFiles, release: Release, secret_fingerprint: str, version: str) -> str:
    """Return a hexadecimal digest of all that decides a mark: equal keys, equal marks."""
    entries = [f"{entry.path} {entry.kind}" for entry in submitted.entries if entry.path not in IGNORED_FILES]
    contents = [part for path in sorted(submitted.contents) for part in (path, submitted.contents[path])]
    context = [secret_fingerprint, version, release.digest, submitted.problem]
    files = submitted.workspace
    workspace = [files] if isinstance(files, str) else [part for pair in files.items() for part in pair]
    return digest_parts([*context, f"{len(entries)}", *entries, *contents, *workspace])


def _workspace(folder: Path) -> Mapping[str, bytes] | str:
    """The sources in a workspace beside the notebook, by path in the folder; or why they can't be used."""
    try:
        if (folder / WORKSPACE).is_symlink():
            raise InvalidFiles(f"`{WORKSPACE}` is a link. Hand in the folder itself.")
        found = read_files(folder / WORKSPACE / "src", f"{WORKSPACE}/src")
    except InvalidFiles as reason:
        return str(reason)
    return {f"{WORKSPACE}/src/{path}": data for path, data in found.items()}


def _content(folder: Path, path: str) -> bytes | str:
    try:
        return read_file(folder, path, MAX_NOTEBOOK_BYTES)
    except Unusable as reason:
        return str(reason)


def _candidates(entries: Sequence[FolderEntry], own: Collection[str]) -> Iterator[str]:
    """Notebooks under other names than the release's: a few, and together of a limited size."""
    found = size = 0
    for entry in entries:
        if entry.kind != FILE or not entry.path.lower().endswith(SUFFIX) or is_hidden(entry.path):
            continue
        if entry.path in own or (found and size + entry.size > MAX_NOTEBOOK_BYTES):
            continue
        found, size = found + 1, size + entry.size
        if found > MAX_CANDIDATES:
            return
        yield entry.path
