"""Lists and reads a folder that a student controls.

Links are never followed, only regular files are opened, no more is read than requested, and nothing in the
folder blocks, such as a pipe without a writer.
"""

import errno
import os
import stat
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from grader.marking.errors import Unusable
from grader.marking.submission.quoting import quote

MAX_ENTRIES = 5000
MAX_DEPTH = 3  # folders in folders
FILE, FOLDER = "a file", "a folder"
KINDS = {
    stat.S_IFREG: FILE,
    stat.S_IFDIR: FOLDER,
    stat.S_IFLNK: "a link",
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
}
_AS_FOLDER = os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC
_AS_FILE = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC


@dataclass(frozen=True)
class FolderEntry:
    """Something in a folder: its path from there with `/`, what it is, and its size in bytes."""

    path: str
    kind: str
    size: int


def list_entries(folder: Path) -> list[FolderEntry]:
    """Return the entries of `folder` and its subfolders, sorted by path: at most MAX_ENTRIES.

    Raises Unusable if `folder` is not a readable folder.
    """
    with ExitStack() as opened:
        found = _below(_folder(folder, opened), "")
        return sorted(islice(found, MAX_ENTRIES), key=lambda entry: entry.path)


def read_file(folder: Path, path: str, limit: int) -> bytes:
    """Return the bytes of the regular file `path` in `folder`.

    Raises Unusable if it is anything else, has more than `limit` bytes, or cannot be read.
    """
    with _file(folder, path) as descriptor, os.fdopen(descriptor, "rb", closefd=False) as file:
        size = os.fstat(descriptor).st_size
        data = file.read(limit + 1) if size <= limit else b""
    if max(size, len(data)) > limit:
        raise Unusable(
            f"{quote(path)} has {max(size, len(data)) / 1e6:.0f} MB; at most {limit / 1e6:.0f} MB can be "
            "marked. Clear its outputs (Edit, Clear Outputs of All Cells), save it and hand it in again."
        )
    return data


@contextmanager
def _file(folder: Path, path: str) -> Iterator[int]:
    *between, name = path.split("/")
    with ExitStack() as opened:
        place = _folder(folder, opened)
        try:
            for part in between:
                place = _opened(part, _AS_FOLDER, opened, place)
            # Checked before opening: opening a device has effects.
            _refuse_all_but_files(path, os.lstat(name, dir_fd=place).st_mode)
            descriptor = _opened(name, _AS_FILE, opened, place)
            _refuse_all_but_files(path, os.fstat(descriptor).st_mode)
        except OSError as error:
            problem = f"{quote(path)} cannot be read ({error.strerror})."
            raise Unusable(f"{problem} Hand in a file that can be read.") from None
        yield descriptor


def _folder(folder: Path, opened: ExitStack) -> int:
    try:
        return _opened(os.fspath(folder), _AS_FOLDER, opened)
    except FileNotFoundError:
        raise Unusable("Expected a notebook, saw nothing: no folder was handed in.") from None
    except OSError as error:
        other = error.errno in (errno.ELOOP, errno.ENOTDIR)
        saw = "a link or a file" if other else f"one that cannot be read ({error.strerror})"
        problem = f"Expected a folder with a notebook, saw {saw}."
        raise Unusable(f"{problem} Hand in the notebook itself.") from None


def _opened(path: str, flags: int, opened: ExitStack, place: int | None = None) -> int:
    descriptor = os.open(path, flags, dir_fd=place)
    opened.callback(os.close, descriptor)
    return descriptor


def _below(place: int, prefix: str) -> Iterator[FolderEntry]:
    folders = []
    for name in sorted(os.listdir(place)):
        with suppress(FileNotFoundError):
            seen = os.lstat(name, dir_fd=place)
            yield FolderEntry(prefix + name, _kind(seen.st_mode), seen.st_size)
            if stat.S_ISDIR(seen.st_mode) and prefix.count("/") < MAX_DEPTH:
                folders.append(name)
    for name in folders:
        with suppress(OSError), ExitStack() as inside:  # an unreadable folder counts as empty
            yield from _below(_opened(name, _AS_FOLDER, inside, place), f"{prefix}{name}/")


def _kind(mode: int) -> str:
    return KINDS.get(stat.S_IFMT(mode), "a device")


def _refuse_all_but_files(path: str, mode: int) -> None:
    if _kind(mode) != FILE:
        problem = f"{quote(path)} is {_kind(mode)}; expected a notebook's file."
        raise Unusable(f"{problem} Hand in the file itself, as JupyterLab gives it (File, Download).")
