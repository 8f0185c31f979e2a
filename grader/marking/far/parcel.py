"""A folder on its way to another machine, where it is as good as here for whoever marks what lies in it.

What is no ordinary file, such as a link or a pipe, arrives as one of its kind that leads nowhere: marking
names it and never opens it.
"""

import os
import stat
import zlib
from pathlib import Path
from typing import Any

from grader.marking.mending.folder import FILE, FOLDER, KINDS, Entry, entries, read_file
from grader.marking.mending.submission import LARGEST
from grader.marking.mending.words import Unusable

Parcel = list[dict[str, Any]]  # plain data for each thing in a folder, the folder itself first
LINK = KINDS[stat.S_IFLNK]
TYPES = {kind: mode for mode, kind in KINDS.items()}


def pack(folder: Path, ending: str = "") -> Parcel:
    """What lies in `folder`; only files whose names have this ending travel with their bytes.

    Raises nothing for anything that a student may have put there.
    """
    if not os.path.lexists(folder):
        return []
    kind = KINDS.get(stat.S_IFMT(os.lstat(folder).st_mode), FILE)
    try:
        inside = entries(folder)
    except Unusable:
        return [_item("", kind, 0, closed=True)]
    return [_item("", kind, 0), *(_packed(folder, entry, ending) for entry in inside)]


def unpack(parcel: Parcel, folder: Path) -> None:
    """Make `folder` what the packed one was. Raises OSError."""
    for item in parcel:
        _make(folder / item["path"], item)
    for item in reversed(parcel):
        if item["closed"] and item["kind"] != LINK:
            (folder / item["path"]).chmod(0)


def _packed(folder: Path, entry: Entry, ending: str) -> dict[str, Any]:
    if entry.kind != FILE or not entry.path.lower().endswith(ending) or entry.size > LARGEST:
        return _item(entry.path, entry.kind, entry.size)
    try:
        data = read_file(folder, entry.path, LARGEST)
    except Unusable:
        return _item(entry.path, entry.kind, entry.size, closed=True)
    return _item(entry.path, entry.kind, entry.size, zlib.compress(data, 1))


def _item(path: str, kind: str, size: int, data: bytes = b"", closed: bool = False) -> dict[str, Any]:
    return {"path": path, "kind": kind, "size": size, "data": data, "closed": closed}


def _make(path: Path, item: dict[str, Any]) -> None:
    match item["kind"]:
        case kind if kind == FOLDER:
            path.mkdir()
        case kind if kind == LINK:
            path.symlink_to("nowhere")
        case kind if kind == FILE and item["data"]:
            path.write_bytes(zlib.decompress(item["data"]))
        case kind if kind == FILE:
            path.touch()
            os.truncate(path, item["size"])  # takes no room: it was not worth sending
        case kind:
            os.mknod(path, TYPES.get(kind, stat.S_IFIFO) | 0o600)  # a device needs rights that we don't have
