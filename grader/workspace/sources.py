"""The files of a workspace as data, read with limits, and looked at again wherever they come from.

Links are never followed, only regular files are opened, and nothing that lies there makes this wait.
"""

from __future__ import annotations

import os
import re
import stat
from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Any

NAME = re.compile(r"[A-Za-z0-9_+-][A-Za-z0-9_.+-]{0,99}")
LEFT_BY_TOOLS = r"\..*|__pycache__|.*\.pyc"
IGNORED = "COLCON_IGNORE"  # colcon leaves out a folder with this file; it puts one into what it makes
KINDS = {stat.S_IFLNK: "a link", stat.S_IFIFO: "a pipe", stat.S_IFSOCK: "a socket"}
_FOLDER = os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC
_FILE = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC

Sources = Mapping[str, bytes]
"""The bytes of files by their path below src/, with `/`."""


class Refused(Exception):
    """These files can't be taken. The words say why, and what to do, to the student and to the instructor."""


@dataclass(frozen=True)
class Most:
    """The most that is taken: files, bytes of one and of all, folders in folders. without: these names."""

    files: int = 200
    file: int = 256_000
    all: int = 2_000_000
    deep: int = 8
    without: str = rf"{LEFT_BY_TOOLS}|.*\.egg-info"


HANDED_IN = Most()
INSTALLED = Most(files=400, file=1_000_000, all=4_000_000, deep=12, without=LEFT_BY_TOOLS)


def read_files(folder: Path, shown: str, most: Most = HANDED_IN) -> dict[str, bytes]:
    """All files below a folder, without what tools leave there; none if there is no folder.

    shown: what the folder is called in the words of a refusal. Raises Refused.
    """
    reading = _Reading(shown, most)
    with ExitStack() as opened:
        try:
            place = os.open(folder, _FOLDER)
        except FileNotFoundError:
            return {}
        except OSError:
            raise Refused(f"{shown} is no folder. Put your packages into a folder of this name.") from None
        opened.callback(os.close, place)
        reading.folder(place, "")
    return reading.found


def checked(files: Any, shown: str, most: Most = HANDED_IN) -> dict[str, bytes]:
    """The same for what another process says that it has read. Raises Refused."""
    if not isinstance(files, dict):
        raise Refused(f"{shown} could not be read.")
    reading = _Reading(shown, most)
    for path, data in files.items():
        if not (isinstance(path, str) and isinstance(data, bytes)):
            raise Refused(f"{shown} could not be read.")
        parts = path.split("/")
        for name in parts:
            reading.name(name, path)
        reading.depth(len(parts) - 1, path)
        reading.file(path, data)
    return reading.found


class _Reading:
    """What was found so far, and whether it is not too much."""

    def __init__(self, shown: str, most: Most) -> None:
        self.found: dict[str, bytes] = {}
        self._shown, self._most, self._size = shown, most, 0

    def folder(self, place: int, prefix: str) -> None:
        """Take all that lies in an open folder, whose path is the prefix."""
        names = sorted(os.listdir(place))
        if IGNORED in names and prefix:
            return
        for name in names:
            if re.fullmatch(self._most.without, name):
                continue
            path = prefix + name
            self.name(name, path)
            try:
                self._entry(place, name, path)
            except OSError as error:
                raise Refused(f"{self._at(path)} can't be read ({error.strerror}).") from None

    def _entry(self, place: int, name: str, path: str) -> None:
        mode = os.lstat(name, dir_fd=place).st_mode
        if not (stat.S_ISDIR(mode) or stat.S_ISREG(mode)):
            kind = KINDS.get(stat.S_IFMT(mode), "a device")
            raise Refused(f"{self._at(path)} is {kind}. Only files are taken: put the file itself there.")
        is_folder = stat.S_ISDIR(mode)
        opened = os.open(name, _FOLDER if is_folder else _FILE, dir_fd=place)
        try:
            if is_folder:
                self.depth(path.count("/") + 1, path)
                self.folder(opened, f"{path}/")
            elif stat.S_ISREG(os.fstat(opened).st_mode):
                with os.fdopen(opened, "rb", closefd=False) as file:
                    self.file(path, file.read(self._most.file + 1))
        finally:
            os.close(opened)

    def name(self, name: str, path: str) -> None:
        """Raises Refused for a name that isn't plain."""
        if not NAME.fullmatch(name):
            raise Refused(f"{self._at(path)}: a name may have 100 letters, digits and `_ . + -`. Rename it.")

    def depth(self, folders: int, path: str) -> None:
        """Raises Refused for what lies too deep."""
        if folders > self._most.deep:
            raise Refused(f"{self._at(path)} lies deeper than {self._most.deep} folders. Move it up.")

    def file(self, path: str, data: bytes) -> None:
        """Take a file. Raises Refused if it is too large, or they are too many."""
        if len(data) > self._most.file:
            raise Refused(
                f"{self._at(path)} has more than {self._most.file // 1000} kB. Leave out what is no source."
            )
        self._size += len(data)
        if self._size > self._most.all:
            raise Refused(
                f"{self._shown} has more than {self._most.all / 1e6:g} MB. Leave out what is no source."
            )
        self.found[path] = data
        if len(self.found) > self._most.files:
            raise Refused(
                f"{self._shown} has more than {self._most.files} files. Leave out what nobody needs."
            )

    def _at(self, path: str) -> str:
        plain = "".join(letter if letter.isprintable() and letter != "`" else "?" for letter in path)
        plain = plain.encode(errors="replace").decode()
        return f"`{self._shown}/{plain if len(plain) <= 80 else plain[:79] + '…'}`"
